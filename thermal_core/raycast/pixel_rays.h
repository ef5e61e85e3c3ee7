#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "raycast/lens_range.h"
#include "raycast/vectors.h"
#include "scene/camera_intrinsics.h"
#include "scene/lens_distortion.h"

namespace thermal {

/// The view of a pose, in single precision, as Blender keeps it.
[[nodiscard]] View view_of(const std::array<double, 16>& camera_to_world) noexcept;

/// Ray directions of a camera: through pixel (x, y), in camera axes, z being 1.
class PixelRays {
 public:
  PixelRays(const CameraIntrinsics& camera, const LensDistortion& lens);

  [[nodiscard]] const CameraIntrinsics& camera() const noexcept { return camera_; }
  [[nodiscard]] int width_px() const noexcept { return camera_.width_px; }
  [[nodiscard]] int height_px() const noexcept { return camera_.height_px; }
  [[nodiscard]] const LensDistortion& lens() const noexcept { return lens_; }
  /// Directions within the picture's border; unbounded if the lens shows nothing somewhere.
  [[nodiscard]] const LensRange& range() const noexcept { return range_; }
  [[nodiscard]] LensPoint at(std::size_t x_px, std::size_t y_px) const noexcept {
    return bent_.empty() ? LensPoint{.x = x_[x_px], .y = y_[y_px]} : bent_[y_px * x_.size() + x_px];
  }

 private:
  CameraIntrinsics camera_;
  LensDistortion lens_;
  LensRange range_;
  std::vector<double> x_;        ///< a pinhole's, by column
  std::vector<double> y_;        ///< by row
  std::vector<LensPoint> bent_;  ///< with lens distortion, row by row; empty: a pinhole
};

}  // namespace thermal
