#include "io/config/lens.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/error.h"
#include "io/config/calibration_file.h"
#include "io/json/camera.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

constexpr std::array<const char*, 4> kIntrinsics = {"fx_px", "fy_px", "cx_px", "cy_px"};

/// Adds a fault for each of a calibration's numbers that a document gives itself.
void check_given_once(const Json& camera, std::vector<std::string>& faults) {
  constexpr const char* kRule = "none beside camera.calibration";
  for (const char* key : kIntrinsics) {
    if (camera.contains(key))
      faults.push_back(fault(fmt::format("camera.{}", key), camera[key].dump(), "px", kRule));
  }
  for (const auto& [key, value] : camera["distortion"].items()) {
    if (value != 0) faults.push_back(fault("camera.distortion." + key, value.dump(), "", kRule));
  }
}

/// The part of a config's `camera` that a calibration stands for.
Json entries_of(const Calibration& found) {
  const auto& [camera, lens] = found;
  return {{"fx_px", camera.fx_px},
          {"fy_px", camera.fy_px},
          {"cx_px", camera.cx_px},
          {"cy_px", camera.cy_px},
          {"distortion", to_json(lens)}};
}

void check_size(const CameraIntrinsics& found, const Json& camera, std::vector<std::string>& faults) {
  const CameraIntrinsics wanted = read_intrinsics(camera);
  if (found.width_px == wanted.width_px && found.height_px == wanted.height_px) return;
  faults.push_back(fault(
      "size of the picture", fmt::format("{} x {}", found.width_px, found.height_px), "px",
      fmt::format("{} x {} px, camera.width_px x camera.height_px", wanted.width_px, wanted.height_px)));
}

void check_lens(const Calibration& found, std::vector<std::string>& faults) {
  try {
    (void)overscan_px(found.camera, found.lens);
  } catch (const ConfigError& error) {
    faults.emplace_back(error.what());
  }
}

/// A calibration's numbers as a config has them. Adds what is wrong with them for this camera.
Json checked_entries(const Calibration& found, const Json& camera, const Json& schema,
                     std::vector<std::string>& faults) {
  Json entries = entries_of(found);
  check_size(found.camera, camera, faults);
  if (!faults.empty()) return entries;
  Json filled = entries;
  faults = check_and_fill(filled, schema["properties"]["camera"]);
  if (faults.empty()) check_intrinsics(found.camera, faults);
  if (faults.empty()) check_lens(found, faults);
  return entries;
}

}  // namespace

CameraIntrinsics read_intrinsics(const Json& camera) {
  const int width_px = camera.at("width_px");
  const int height_px = camera.at("height_px");
  const double f_px =
      camera.at("focal_length_m").get<double>() / (camera.at("pixel_pitch_um").get<double>() * 1e-6);
  const double fx_px = camera.value("fx_px", f_px);
  return {.width_px = width_px,
          .height_px = height_px,
          .fx_px = fx_px,
          .fy_px = camera.value("fy_px", fx_px),
          .cx_px = camera.value("cx_px", width_px / 2.0),
          .cy_px = camera.value("cy_px", height_px / 2.0)};
}

bool gives_intrinsics(const Json& camera) {
  return std::ranges::any_of(kIntrinsics, [&](const char* key) { return camera.contains(key); });
}

void apply_lens(Json& document, const Json& schema, std::vector<std::string>& faults) {
  Json& camera = document["camera"];
  if (const auto lens = camera.find("lens_mm"); lens != camera.end()) {
    camera["focal_length_m"] = lens->get<double>() / 1000;
    camera.erase("lens_mm");
  }
  if (!camera.contains("calibration")) return;
  check_given_once(camera, faults);
  if (!faults.empty()) return;
  const auto file = camera["calibration"].get<std::string>();
  camera.erase("calibration");
  try {
    std::vector<std::string> found_faults;
    camera.update(checked_entries(read_calibration(file), camera, schema, found_faults));
    for (const std::string& one : found_faults)
      faults.push_back(fmt::format("camera.calibration: {}: {}", file, one));
  } catch (const Error& error) {
    faults.push_back(fmt::format("camera.calibration: {}", error.what()));
  }
}

void check_intrinsics(const CameraIntrinsics& camera, std::vector<std::string>& faults) {
  const auto check = [&](const char* key, double value_px, double least_px, double most_px,
                         const char* meaning) {
    if (value_px >= least_px && value_px <= most_px) return;
    faults.push_back(fault(fmt::format("camera.{}", key), fmt::format("{}", value_px), "px",
                           fmt::format("{} to {} px, {}", least_px, most_px, meaning)));
  };
  check("cx_px", camera.cx_px, 0, camera.width_px, "within the picture");
  check("cy_px", camera.cy_px, 0, camera.height_px, "within the picture");
  constexpr double kMostAspect = 10;
  check("fy_px", camera.fy_px, camera.fx_px / kMostAspect, camera.fx_px * kMostAspect,
        "a tenth to ten times camera.fx_px");
}

int fill_overscan(Json& document, const DatasetSpec& spec, std::vector<std::string>& faults) {
  int needed_px = 0;
  const auto add = [&](const ClipSettings& one) {
    needed_px = std::max(needed_px, overscan_px(one.camera, one.distortion));
  };
  try {
    add(*spec.settings);
    for (const ClipSpec& clip : spec.clips)
      if (clip.settings != spec.settings) add(*clip.settings);
    for (const FlightSpec& flight : spec.flights) add(*flight.settings);
  } catch (const ConfigError& error) {
    faults.emplace_back(error.what());
    return 0;
  }
  const bool rays_bend = document["render"]["engine"] == "embree";
  Json& given = document["render"]["overscan_px"];
  if (given.is_null()) given = rays_bend ? 0 : needed_px;
  if (rays_bend && given != 0)
    faults.push_back(fault("render.overscan_px", given.dump(), "px",
                           "none with the engine embree, whose rays follow the lens"));
  if (!rays_bend && given.get<int>() < needed_px)
    faults.push_back(fault("render.overscan_px", given.dump(), "px",
                           fmt::format("at least {} px for camera.distortion, or none given", needed_px)));
  return needed_px;
}

}  // namespace thermal
