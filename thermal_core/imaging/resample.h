#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "scene/lens_distortion.h"

namespace thermal {

/// Maps the camera's pixels into a pinhole picture that extends `overscan_px` further on every side. Without
/// distortion this is a crop. Not cv::remap(): it rounds positions to 1/32 px, and bits must not depend on the machine.
class ResampleMap {
 public:
  /// `overscan_px` must be at least what the lens needs (thermal::overscan_px); asserted.
  ResampleMap(const CameraIntrinsics& camera, int overscan_px, const LensDistortion& lens);

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }

  /// Radiance as shown by the lens: bilinear between the centres of four pixels; not finite if one of the four is not.
  /// A crop copies.
  void resample_linear(const Plane<float>& in, Plane<float>& out) const;

  /// Indices as shown by the lens, from the nearest pixel.
  [[nodiscard]] Plane<std::uint16_t> resample_nearest(const Plane<std::uint16_t>& in) const;

  /// Number of uses of each pixel of the pinhole picture by resample_nearest().
  [[nodiscard]] Plane<std::uint16_t> times_shown() const;

 private:
  [[nodiscard]] std::size_t nearest(std::size_t pixel, const Plane<std::uint16_t>& in) const noexcept;
  void place_row(const CameraIntrinsics& camera, const LensDistortion& lens, int y);
  template <typename T>
  void crop(const Plane<T>& in, Plane<T>& out) const;

  int width_px_;
  int height_px_;
  int overscan_px_;
  // By pixel of the camera, empty for a crop: the upper left of the four pixels, and the fractions towards the
  // others.
  std::vector<std::int32_t> corner_;
  std::vector<float> x_share_;
  std::vector<float> y_share_;
};

}  // namespace thermal
