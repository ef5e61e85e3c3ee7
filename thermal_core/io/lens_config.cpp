#include "io/lens_config.h"

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

/// As blender_scripts/veldt/camera.py has it: the principal point in the middle, f_px = focal length / pixel pitch.
CameraIntrinsics intrinsics_of(const Json& camera) {
  const int width_px = camera["width_px"];
  const int height_px = camera["height_px"];
  const double f_px =
      camera["focal_length_m"].get<double>() / (camera["pixel_pitch_um"].get<double>() * 1e-6);
  return {.width_px = width_px,
          .height_px = height_px,
          .fx_px = f_px,
          .fy_px = f_px,
          .cx_px = width_px / 2.0,
          .cy_px = height_px / 2.0};
}

}  // namespace

LensDistortion read_distortion(const Json& json) {
  return {.k1 = json["k1"], .k2 = json["k2"], .p1 = json["p1"], .p2 = json["p2"]};
}

void fill_overscan(Json& document, std::vector<std::string>& faults) {
  const Json& camera = document["camera"];
  try {
    const int needed_px = overscan_px(intrinsics_of(camera), read_distortion(camera["distortion"]));
    Json& given = document["render"]["overscan_px"];
    if (given.is_null()) given = needed_px;
    if (given.get<int>() >= needed_px) return;
    faults.push_back(fault("render.overscan_px", given.dump(), "px",
                           fmt::format("at least {} px for camera.distortion, or none given", needed_px)));
  } catch (const ConfigError& error) {
    faults.emplace_back(error.what());
  }
}

}  // namespace thermal
