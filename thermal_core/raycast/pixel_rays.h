#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "raycast/vectors.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"

namespace thermal {

/// The view of a pose, in single precision, as Blender keeps it.
[[nodiscard]] View view_of(const std::array<double, 16>& camera_to_world) noexcept;

/// Where the rays of a camera go: through pixel (x, y), in camera axes, z being 1.
class PixelRays {
 public:
  PixelRays(const CameraIntrinsics& camera, const LensDistortion& lens);

  [[nodiscard]] const CameraIntrinsics& camera() const noexcept { return camera_; }
  [[nodiscard]] int width_px() const noexcept { return camera_.width_px; }
  [[nodiscard]] int height_px() const noexcept { return camera_.height_px; }
  [[nodiscard]] bool is_pinhole() const noexcept { return bent_.empty(); }
  [[nodiscard]] LensPoint at(std::size_t x_px, std::size_t y_px) const noexcept {
    return bent_.empty() ? LensPoint{.x = x_[x_px], .y = y_[y_px]} : bent_[y_px * x_.size() + x_px];
  }

 private:
  CameraIntrinsics camera_;
  std::vector<double> x_;        ///< a pinhole's, by column
  std::vector<double> y_;        ///< by row
  std::vector<LensPoint> bent_;  ///< a lens's, row by row; empty: a pinhole
};

}  // namespace thermal
