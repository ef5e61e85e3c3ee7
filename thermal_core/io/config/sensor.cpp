#include "io/config/sensor.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/config/spectra.h"
#include "io/json/schema.h"

namespace thermal {

ProcessingParameters read_processing(const Json& processing) {
  return {.noise_filter_sigma_px = processing["noise_filter_sigma_px"],
          .unsharp_amount = processing["unsharp_amount"],
          .unsharp_sigma_px = processing["unsharp_sigma_px"]};
}

AnalogueLinkParameters read_link(const Json& link) {
  const bool is_pal = link["standard"] == "pal";
  const Json& deinterlace = link["deinterlace"];
  return {.field_rate_hz = is_pal ? 50 : 60 / 1.001,
          .active_line_us = is_pal ? 52 : 52.66,
          .lines = link["lines"] == "frame" ? 0
                   : is_pal                 ? 576
                                            : 480,
          .bandwidth_mhz = link["bandwidth_mhz"],
          .deinterlace = deinterlace == "bob"     ? Deinterlace::bob
                         : deinterlace == "blend" ? Deinterlace::blend
                                                  : Deinterlace::weave,
          .noise_levels = link["noise_levels"],
          .streak_levels = link["streak_levels"],
          .streak_us = link["streak_us"],
          .row_levels = link["row_levels"],
          .drift_levels = link["drift_levels"],
          .drift_rows = link["drift_rows"],
          .hum_levels = link["hum_levels"],
          .hum_hz = link["hum_hz"],
          .jitter_px = link["jitter_px"],
          .dropouts_per_s = link["dropouts_per_s"],
          .dropout_us = link["dropout_us"]};
}

namespace {

constexpr const char* kDefaultPreset = "airsim_w";
const std::vector<std::string> kCameraSections = {"camera", "sensor"};

/// Path of the file of assets/`kind` that a key names; ConfigError with the available ones.
Path find_asset(const Path& folder, const std::string& extension, const std::string& asset,
                const std::string& where) {
  std::vector<std::string> known;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == extension) known.push_back(entry.path().stem().string());
  }
  std::sort(known.begin(), known.end());
  if (std::binary_search(known.begin(), known.end(), asset)) return folder / (asset + extension);
  throw ConfigError(
      fault(where, fmt::format("\"{}\"", asset), "", "one of " + list_names(known, known.size())) +
      did_you_mean(asset, known));
}

/// Adds missing members from another object, at every depth.
void fill_missing(Json& object, const Json& from) {
  for (const auto& [key, value] : from.items()) {
    if (!object.contains(key)) {
      object[key] = value;
    } else if (object[key].is_object() && value.is_object()) {
      fill_missing(object[key], value);
    }
  }
}

/// Checks a preset as part of an otherwise empty config.
Json read_preset(const Path& file, const Json& schema, const std::vector<std::string>& sections) {
  Json keys = {{"description", {{"type", "string"}}}};
  for (const std::string& section : sections) keys[section] = schema["properties"][section];
  if (keys.contains("camera"))
    keys["camera"]["properties"].erase("lens_mm");  // of configs: short for focal_length_m
  keys["models"] = {{"type", "array"}, {"items", {{"type", "string"}}}};
  keys["sources"] = {{"type", "object"}};
  const Json rules = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(keys)}};
  Json preset = read_json(file);
  Json filled = preset;
  throw_faults(check_and_fill(filled, rules), file.string());
  return preset;
}

/// A preset, with the values of those that it builds on wherever it gives none. `where` is the key that names it.
Json read_whole_preset(const std::string& name, const std::string& where, const Json& schema,
                       const Assets& assets) {
  Json whole = Json::object();
  std::vector<std::string> built_on;
  std::string next = name;
  std::string place = where;
  while (!next.empty()) {
    if (std::ranges::find(built_on, next) != built_on.end())
      throw ConfigError(
          fault(place, fmt::format("\"{}\"", next), "", "a preset that does not build on this one"));
    built_on.push_back(next);
    const Path file = find_asset(assets.folder("sensors"), ".json", next, place);
    const Json preset = read_preset(file, schema, kCameraSections);
    fill_missing(whole, preset);
    next = preset.value(Json::json_pointer("/sensor/preset"), "");
    place = file.string() + ": sensor.preset";
  }
  return whole;
}

/// Adds what output.preset names, if it does.
void fill_output(Json& document, const Json& schema, const std::string& where, const Assets& assets) {
  const Json::json_pointer key("/output/preset");
  if (!document.contains(key) || !document[key].is_string()) return;
  const Path file = find_asset(assets.folder("links"), ".json", document[key], where + "output.preset");
  fill_missing(document["output"], read_preset(file, schema, {"output"}).value("output", Json::object()));
}

OpticsParameters read_optics(const Json& json, const Json& camera) {
  return {.psf = json["psf"] == "physical" ? Psf::physical : Psf::gaussian,
          .blur_sigma_px = json["blur_sigma_px"],
          .f_number = json["f_number"],
          .aberration_sigma_px = json["aberration_sigma_px"],
          .defocus_um = json["defocus_um"],
          .pixel_pitch_um = camera["pixel_pitch_um"]};
}

NoiseParameters read_noise(const Json& json) {
  return {.amount = json["amount"],
          .flicker_knee_hz = json["flicker_knee_hz"],
          .fixed_pattern_ratio = json["fixed_pattern_ratio"],
          .row_ratio = json["row_ratio"],
          .column_ratio = json["column_ratio"],
          .temporal_row_ratio = json["temporal_row_ratio"],
          .temporal_column_ratio = json["temporal_column_ratio"],
          .frame_ratio = json["frame_ratio"],
          .drift_ratio = json["drift_ratio"],
          .first_frame_ratio = json["first_frame_ratio"],
          .banding_ratio = json["banding_ratio"],
          .banding_period_px = json["banding_period_px"],
          .banding_hz = json["banding_hz"]};
}

BadPixelParameters read_bad_pixels(const Json& json) {
  return {.dead_share = json["dead_share"],
          .replace_dead = json["replace_dead"],
          .blinking_share = json["blinking_share"],
          .blinking_ratio = json["blinking_ratio"],
          .blinking_hz = json["blinking_hz"],
          .late_dead_per_hour = json["late_dead_per_hour"]};
}

AgcMode read_mode(const std::string& name) {
  if (name == "table_max") return AgcMode::table_max;
  if (name == "linear") return AgcMode::linear;
  if (name == "percentile") return AgcMode::percentile;
  if (name == "information") return AgcMode::information;
  if (name == "clahe") return AgcMode::clahe;
  return name == "plateau" ? AgcMode::plateau : AgcMode::scene_max;
}

AgcParameters read_agc(const Json& json) {
  return {.mode = read_mode(json["mode"]),
          .polarity = json["polarity"] == "black_hot" ? Polarity::black_hot : Polarity::white_hot,
          .low_k = json["low_k"],
          .high_k = json["high_k"],
          .tail_percent = json["tail_percent"],
          .plateau_percent = json["plateau_percent"],
          .linear_percent = json["linear_percent"],
          .max_gain_dn_per_netd = json["max_gain_dn_per_netd"],
          .damping_s = json["damping_s"],
          .information_threshold_netd = json["information_threshold_netd"],
          .flat_weight = json["flat_weight"],
          .clip_limit = json["clip_limit"],
          .tiles_across = json["tiles_across"],
          .tiles_down = json["tiles_down"],
          .black_level = json["black_level"],
          .white_level = json["white_level"],
          .detail = {.gain_dn_per_netd = json["detail"]["gain_dn_per_netd"],
                     .radius_px = json["detail"]["radius_px"],
                     .edge_netd = json["detail"]["edge_netd"],
                     .noise_netd = json["detail"]["noise_netd"]}};
}

}  // namespace

void apply_preset(Json& document, const Json& schema, const std::string& where, const Assets& assets) {
  if (!document.is_object()) return;  // the schema reports it
  fill_output(document, schema, where, assets);
  for (const char* key : {"sensor", "camera"}) {
    if (!document.contains(key)) document[key] = Json::object();
    if (!document[key].is_object()) return;
  }
  const Json& camera = document["camera"];
  if (camera.contains("lens_mm") && camera.contains("focal_length_m"))
    throw ConfigError(fault(where + "camera.focal_length_m", brief(camera["focal_length_m"]), "m",
                            "none beside camera.lens_mm, which is the same in mm"));
  Json& sensor = document["sensor"];
  if (!sensor.contains("preset")) sensor["preset"] = kDefaultPreset;
  if (!sensor["preset"].is_string()) return;
  const Json preset = read_whole_preset(sensor["preset"], where + "sensor.preset", schema, assets);
  fill_missing(sensor, preset.value("sensor", Json::object()));
  fill_missing(document["camera"], preset.value("camera", Json::object()));
}

std::map<std::string, Json> sensor_presets(const Json& schema, const Assets& assets) {
  std::map<std::string, Json> presets;
  for (const auto& entry : std::filesystem::directory_iterator(assets.folder("sensors")))
    if (entry.path().extension() == ".json")
      presets[entry.path().stem().string()] = read_preset(entry.path(), schema, kCameraSections);
  return presets;
}

SensorParameters read_sensor(const Json& document, const std::string& where, const Assets& assets) {
  const Json& json = document["sensor"];
  const Path response =
      find_asset(assets.folder("responses"), ".csv", json["response"], where + "sensor.response");
  return {.response = read_response(response),
          .radiance = json["radiance"] == "script" ? RadianceModel::script : RadianceModel::exact,
          .optics = read_optics(json["optics"], document["camera"]),
          .time_constant_s = json["time_constant_s"],
          .readout_s = json["readout_s"],
          .netd_mk = json["netd_mk"],
          .native_rate_hz = json["native_rate_hz"],
          .netd_f_number = json["netd_f_number"],
          .noise = read_noise(json["noise"]),
          .shutter = {.interval_s = json["shutter"]["interval_s"], .freeze_s = json["shutter"]["freeze_s"]},
          .housing = {.excess_k = json["housing"]["excess_k"],
                      .gain_error_share = json["housing"]["gain_error_share"],
                      .halo_k = json["housing"]["halo_k"]},
          .bad_pixels = read_bad_pixels(json["bad_pixels"]),
          .accuracy_k = json["accuracy_k"],
          .denoise = {.share_of_new = json["denoise"]["share_of_new"],
                      .motion_sigma = json["denoise"]["motion_sigma"]},
          .processing = read_processing(json["processing"]),
          .kelvin_per_count = json["kelvin_per_count"],
          .saturation_k = json["saturation_k"],
          .agc = read_agc(json["agc"])};
}

}  // namespace thermal
