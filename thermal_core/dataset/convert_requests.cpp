#include "dataset/convert_requests.h"

#include <optional>
#include <utility>

#include "base/error.h"
#include "io/variants.h"

namespace thermal {
namespace {

/// What stands for a config where none is given.
Json default_document(const std::vector<ClipPasses>& sources) {
  Json clips = Json::array();
  for (const ClipPasses& source : sources) {
    const Manifest& manifest = source.manifest;
    clips.push_back({{"id", manifest.clip},
                     {"season", "winter"},
                     {"frames", manifest.frames.size()},
                     {"frame_rate_hz", manifest.frame_rate_hz}});
  }
  const Manifest& first = sources.front().manifest;
  return {{"name", first.scene.empty() ? "converted" : first.scene},
          {"seed", first.seed},
          {"clips", std::move(clips)}};
}

/// The clip a manifest tells of, where that is cut from one of the config's flights: FLIGHT_0012 is, of FLIGHT.
std::optional<Json> clip_of_flight(const Config& config, const Manifest& manifest) {
  const std::string flight_id = manifest.clip.substr(0, manifest.clip.rfind('_'));
  for (const Json& flight : config.resolved["flights"]) {
    if (flight["id"] != flight_id) continue;
    return Json{{"id", manifest.clip},
                {"of_flight", flight_id},
                {"season", flight["season"]},
                {"start_s", manifest.frames.front().time_s},
                {"frames", manifest.frames.size()},
                {"frame_rate_hz", manifest.frame_rate_hz},
                {"flight", flight["flight"]}};
  }
  return std::nullopt;
}

/// Keeps of a config what is about these clips, so that the dataset is complete once they are made.
Config only_clips_of(Config config, const std::vector<ClipPasses>& sources) {
  Json documents = Json::array();
  for (const ClipPasses& source : sources) {
    const Manifest& manifest = source.manifest;
    if (const auto cut = clip_of_flight(config, manifest)) {
      documents.push_back(*cut);
      continue;
    }
    (void)config.clip(manifest.clip, source.folder.string() + ": clip");
    for (const Json& document : config.resolved["clips"]) {
      if (document["id"] == manifest.clip) documents.push_back(document);
    }
  }
  config.clips.clear();
  config.resolved["clips"] = Json::array();
  return with_flights_cut(std::move(config), documents);
}

/// A folder is a dataset or holds datasets: clips of one must not lie among the others.
void check_out(const Path& out) {
  if (!Layout{out}.is_begun()) return;
  throw ConfigError(
      fault("--out", out.string(), "", "a folder that is no dataset itself, for those of --variants"));
}

}  // namespace

std::vector<ConvertRequest> convert_requests(const ConvertOptions& options,
                                             const std::vector<ClipPasses>& sources) {
  Json document = options.config.value_or(default_document(sources));
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  const std::string name = options.config ? options.config_name : "--set";
  // Resolved even if only variants are made, so that faults all of them share are not put down to the first.
  Config shared = only_clips_of(resolve_config(document, name, options.home), sources);
  std::vector<ConvertRequest> requests;
  if (!options.variants) {
    requests.push_back({.variant = "", .where = "", .config = std::move(shared), .out = options.out});
    return requests;
  }
  check_out(options.out);
  for (const Variant& variant : read_variants(*options.variants, options.variants_name, options.home)) {
    Config config = resolve_config(changed_by(variant, document), variant.where, options.home);
    requests.push_back({.variant = variant.name,
                        .where = variant.where,
                        .config = only_clips_of(std::move(config), sources),
                        .out = options.out / variant.name});
  }
  return requests;
}

}  // namespace thermal
