#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "scene/lens_distortion.h"

namespace thermal {

/// Where the camera's pixels lie in a pinhole's picture that reaches `overscan_px` pixels further on every side.
/// Without distortion that is a crop.
class ResampleMap {
 public:
  /// `overscan_px` is at least what the lens needs (thermal::overscan_px), or this is a programmer's fault.
  ResampleMap(const CameraIntrinsics& camera, int overscan_px, const LensDistortion& lens);

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }

  /// Radiance as the lens shows it: bilinear between the centres of four pixels. Where one of the four is not
  /// finite, neither is the result; other pixels are not touched by it. A crop copies.
  void resample_linear(const Plane<float>& in, Plane<float>& out) const;

  /// Indices as the lens shows them: that of the nearest pixel.
  [[nodiscard]] Plane<std::uint16_t> resample_nearest(const Plane<std::uint16_t>& in) const;

  /// How many of the camera's pixels resample_nearest() has show each pixel of the pinhole's picture.
  [[nodiscard]] Plane<std::uint16_t> times_shown() const;

 private:
  [[nodiscard]] std::size_t nearest(std::size_t pixel, const Plane<std::uint16_t>& in) const noexcept;
  void place_row(const CameraIntrinsics& camera, const LensDistortion& lens, int y);
  template <typename T>
  void crop(const Plane<T>& in, Plane<T>& out) const;

  int width_px_;
  int height_px_;
  int overscan_px_;
  // By pixel of the camera, empty for a crop: the upper left one of the four, and how far towards the others.
  std::vector<std::int32_t> corner_;
  std::vector<float> x_share_;
  std::vector<float> y_share_;
};

}  // namespace thermal
