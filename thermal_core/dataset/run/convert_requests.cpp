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

/// Nothing is rendered here: an engine that the config leaves open is not one that drew the passes.
ResolvedConfig resolved(const Json& document, const std::string& name, const Assets& assets) {
  ResolvedConfig config = resolve_config(document, name, assets);
  if (!config.spec.engine_reason.empty()) config.document["render"]["engine"] = "auto";
  return config;
}

/// One of the config's clips, or cut from one of its flights.
ClipSpec clip_of(const ClipPasses& source, const DatasetSpec& spec) {
  const Manifest& manifest = source.manifest;
  const FlightSpec* flight = spec.flight(manifest.of_flight);
  if (flight == nullptr) return spec.clip(manifest.clip, source.folder.string() + ": clip");
  return flight->cut({.id = manifest.clip,
                      .frames = static_cast<int>(manifest.frames.size()),
                      .frame_rate_hz = manifest.frame_rate_hz,
                      .start_s = manifest.frames.front().time_s});
}

/// Reduces a config to these clips, so that the dataset is complete once they are made.
ResolvedConfig only_clips_of(ResolvedConfig config, const std::vector<ClipPasses>& sources) {
  std::vector<ClipSpec> clips;
  for (const ClipPasses& source : sources) clips.push_back(clip_of(source, config.spec));
  return with_clips(std::move(config), std::move(clips));
}

/// The folder of a file that names others. Without a file, names are relative to the working folder.
Path folder_of(const std::string& file) { return std::filesystem::absolute(file).parent_path(); }

/// The passes were rendered with the manifest's camera. A config that gives intrinsics, directly or by a calibration, must
/// give the same ones: ConfigError if not.
void check_cameras(const DatasetSpec& spec, const std::vector<ClipPasses>& sources, const std::string& name) {
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const ClipPasses& source = sources[k];
    const ClipSettings& settings = *spec.clips[k].settings;
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
  ResolvedConfig shared = only_clips_of(resolved(document, name, options.assets), sources);
  check_cameras(shared.spec, sources, name);
  if (!shared.spec.settings->gives_intrinsics) check_settings(options, sources);
  std::vector<ConvertRequest> requests;
  if (!options.variants) {
    requests.push_back({.variant = "", .where = "", .config = std::move(shared), .out = options.out});
    return requests;
  }
  check_out(options.out);
  for (const Variant& variant : read_variants(*options.variants, options.variants_name, options.assets)) {
    ResolvedConfig config = resolved(changed_by(variant, document), variant.where, options.assets);
    requests.push_back({.variant = variant.name,
                        .where = variant.where,
                        .config = only_clips_of(std::move(config), sources),
                        .out = options.out / variant.name});
  }
  return requests;
}

}  // namespace thermal
