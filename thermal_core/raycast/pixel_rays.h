#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "raycast/vectors.h"
#include "scene/camera_model.h"

namespace thermal {

/// A rectangle of normalised coordinates; empty until points are added.
struct LensRange {
  LensPoint least = {.x = std::numeric_limits<double>::infinity(),
                     .y = std::numeric_limits<double>::infinity()};
  LensPoint most = {.x = -std::numeric_limits<double>::infinity(),
                    .y = -std::numeric_limits<double>::infinity()};

  /// Widens the range to hold a point; NaN changes nothing.
  void add(const LensPoint& point) noexcept;
  [[nodiscard]] bool is_empty() const noexcept { return !(least.x <= most.x && least.y <= most.y); }
};

/// The intersection of two ranges.
[[nodiscard]] LensRange common(const LensRange& a, const LensRange& b) noexcept;

/// A range that contains distort() of every point of a non-empty range, by interval arithmetic. It is wider than
/// necessary by a share of the range's size: 6 % for k1 = -0.2 at 0.4 from the axis.
[[nodiscard]] LensRange distort(const LensDistortion& lens, const LensRange& range) noexcept;

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
