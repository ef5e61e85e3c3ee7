#include "dataset/run/convert_requests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/dataset_file.h"
#include "io/config/lens.h"
#include "io/config/variants.h"
#include "io/json/camera.h"

namespace thermal {
namespace {

/// Used in place of a config if none is given.
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
          {"camera", {{"distortion", to_json(first.lens)}}},
          {"clips", std::move(clips)}};
}

/// The clip of a manifest, if it is cut from one of the config's flights.
std::optional<Json> clip_of_flight(const Config& config, const Manifest& manifest) {
  for (const Json& flight : config.resolved["flights"]) {
    if (flight["id"] != manifest.of_flight) continue;
    return cut_from(flight, {{"id", manifest.clip},
                             {"start_s", manifest.frames.front().time_s},
                             {"frames", manifest.frames.size()},
                             {"frame_rate_hz", manifest.frame_rate_hz}});
  }
  return std::nullopt;
}

/// Nothing is rendered here: an engine that the config leaves open is not one that drew the passes.
Config resolved(const Json& document, const std::string& name, const Assets& assets) {
  Config config = resolve_config(document, name, assets);
  if (!config.engine_reason.empty()) config.resolved["render"]["engine"] = "auto";
  return config;
}

/// Reduces a config to these clips, so that the dataset is complete once they are made.
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
  return with_clips(std::move(config), documents);
}

/// The folder of a file that names others. Without a file, names are relative to the working folder.
Path folder_of(const std::string& file) { return std::filesystem::absolute(file).parent_path(); }

/// The passes were rendered with the manifest's camera. A config that gives intrinsics, directly or by a calibration, must
/// give the same ones: ConfigError if not.
void check_cameras(const Config& config, const std::vector<ClipPasses>& sources, const std::string& name) {
  for (const ClipPasses& source : sources) {
    const ClipSettings& settings = settings_of(config, config.clip(source.manifest.clip, "manifest: clip"));
    if (!settings.gives_intrinsics) continue;
    const CameraIntrinsics& given = settings.camera;
    const CameraIntrinsics& there = source.manifest.camera;
    const auto check = [&](const char* key, double given_px, double there_px) {
      constexpr double kSamePx = 0.01;
      if (std::abs(given_px - there_px) <= kSamePx) return;
      throw ConfigError(fmt::format(
          "{}: {}", name,
          fault(fmt::format("camera.{}", key), fmt::format("{}", given_px), "px",
                fmt::format("{} px, as the passes in {} have it", there_px, source.folder.string()))));
    };
    check("width_px", given.width_px, there.width_px);
    check("height_px", given.height_px, there.height_px);
    check("fx_px", given.fx_px, there.fx_px);
    check("fy_px", given.fy_px, there.fy_px);
    check("cx_px", given.cx_px, there.cx_px);
    check("cy_px", given.cy_px, there.cy_px);
  }
}

/// ConfigError if a setting changes the pinhole of a camera that the passes have already: only the lens is applied to
/// passes.
void check_settings(const ConvertOptions& options, const std::vector<ClipPasses>& sources) {
  constexpr std::array kPinhole = {"width_px", "height_px", "focal_length_m", "lens_mm", "pixel_pitch_um"};
  for (const std::string& setting : options.settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (std::ranges::none_of(kPinhole, [&](const char* one) { return key == std::string("camera.") + one; }))
      continue;
    throw ConfigError(fault("--set", "\"" + setting + "\"", "",
                            fmt::format("no camera; the manifest of {} has that of its passes",
                                        sources.front().folder.string())));
  }
}

/// A folder either is a dataset or holds datasets: clips of one must not be mixed with the others.
void check_out(const Path& out) {
  if (!Layout{out}.is_begun()) return;
  throw ConfigError(
      fault("--out", out.string(), "", "a folder that is not a dataset, to hold those of --variants"));
}

}  // namespace

std::vector<ConvertRequest> convert_requests(const ConvertOptions& options,
                                             const std::vector<ClipPasses>& sources) {
  Json document = options.config.value_or(default_document(sources));
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  const std::string name = options.config ? options.config_name : "--set";
  root_resolved_files(document, folder_of(options.config ? options.config_name : "."));
  // Resolved even if only variants are made, so that shared faults are not attributed to the first variant.
  Config shared = only_clips_of(resolved(document, name, options.assets), sources);
  check_cameras(shared, sources, name);
  if (!shared.gives_intrinsics) check_settings(options, sources);
  std::vector<ConvertRequest> requests;
  if (!options.variants) {
    requests.push_back({.variant = "", .where = "", .config = std::move(shared), .out = options.out});
    return requests;
  }
  check_out(options.out);
  for (const Variant& variant : read_variants(*options.variants, options.variants_name, options.assets)) {
    Config config = resolved(changed_by(variant, document), variant.where, options.assets);
    requests.push_back({.variant = variant.name,
                        .where = variant.where,
                        .config = only_clips_of(std::move(config), sources),
                        .out = options.out / variant.name});
  }
  return requests;
}

}  // namespace thermal
