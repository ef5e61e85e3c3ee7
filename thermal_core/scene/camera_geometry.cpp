#include "scene/camera_geometry.h"

#include <cmath>

#include "base/parallel.h"

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

int samples_across_pixel(const Manifest& manifest) noexcept {
  constexpr int kOfCoverage = 64;  // more samples change the transfer by less than 3e-4 up to Nyquist
  return manifest.supersample * (manifest.cryptomatte.empty() ? 1 : kOfCoverage);
}

CameraRays::CameraRays(const CameraIntrinsics& camera, const LensDistortion& lens)
    : x_(camera.width_px, camera.height_px),
      y_(camera.width_px, camera.height_px),
      length_(camera.width_px, camera.height_px),
      pixel_width_(static_cast<float>(1 / std::sqrt(camera.fx_px * camera.fy_px))) {
  parallel_for(static_cast<std::size_t>(camera.height_px), 8, [&](std::size_t begin, std::size_t end) {
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int column = 0; column < camera.width_px; ++column) {
        const LensPoint ray = unproject(camera, lens, {column + 0.5, row + 0.5});
        const auto x = static_cast<float>(ray.x);
        const auto y = static_cast<float>(ray.y);
        x_.at(column, row) = x;
        y_.at(column, row) = y;
        length_.at(column, row) = std::sqrt(x * x + y * y + 1);
      }
    }
  });
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
