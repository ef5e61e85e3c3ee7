#include "scene/camera_geometry.h"

#include <cmath>

namespace thermal {

CameraIntrinsics finer(const CameraIntrinsics& camera, int factor) noexcept {
  return {.width_px = camera.width_px * factor,
          .height_px = camera.height_px * factor,
          .fx_px = camera.fx_px * factor,
          .fy_px = camera.fy_px * factor,
          .cx_px = camera.cx_px * factor,
          .cy_px = camera.cy_px * factor};
}

CameraIntrinsics pixels_camera(const Manifest& manifest) noexcept {
  CameraIntrinsics wider = manifest.camera;
  wider.width_px += 2 * manifest.overscan_px;
  wider.height_px += 2 * manifest.overscan_px;
  wider.cx_px += manifest.overscan_px;
  wider.cy_px += manifest.overscan_px;
  return wider;
}

CameraIntrinsics passes_camera(const Manifest& manifest) noexcept {
  return finer(pixels_camera(manifest), manifest.supersample);
}

CameraRays::CameraRays(const CameraIntrinsics& camera)
    : length_(camera.width_px, camera.height_px),
      pixel_width_(static_cast<float>(1 / std::sqrt(camera.fx_px * camera.fy_px))) {
  for (int x = 0; x < camera.width_px; ++x) {
    x_.push_back(static_cast<float>((x + 0.5 - camera.cx_px) / camera.fx_px));
  }
  for (int y = 0; y < camera.height_px; ++y) {
    y_.push_back(static_cast<float>((y + 0.5 - camera.cy_px) / camera.fy_px));
    const auto row = length_.row(y);
    for (std::size_t x = 0; x < row.size(); ++x) {
      row[x] = std::sqrt(x_[x] * x_[x] + y_.back() * y_.back() + 1);
    }
  }
}

Plane<float> falloff_noise_gain(const CameraIntrinsics& camera) {
  Plane<float> gain = CameraRays(camera).length();  // 1 / cos
  for (float& value : gain.pixels()) value = value * value * value * value;
  return gain;
}

CameraPose pose_of(const std::array<double, 16>& camera_to_world) noexcept {
  CameraPose pose;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      pose.rotation.at(row).at(column) = static_cast<float>(camera_to_world.at(4 * row + column));
    }
    pose.position_m.at(row) = static_cast<float>(camera_to_world.at(4 * row + 3));
  }
  return pose;
}

}  // namespace thermal
