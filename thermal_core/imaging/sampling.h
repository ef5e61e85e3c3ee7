#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/instances.h"
#include "scene/camera_model.h"
#include "scene/manifest.h"
#include "scene/passes.h"
#include "sensor/optics/round_kernel.h"

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

/// Means of blocks of factor x factor pixels; sides must be multiples of it. NaN propagates to its block.
[[nodiscard]] Plane<float> block_means(const Plane<float>& fine, int factor);

/// Index plane for labels: in each block of factor x factor pixels, the actor that covers at least half of it,
/// otherwise 0. If two actors cover half each: the lower index. `uses` is the fine plane's survey; pixels outside the
/// actors' boxes are not read.
[[nodiscard]] Plane<std::uint16_t> block_actors(const Plane<std::uint16_t>& fine, int factor,
                                                std::span<const IndexUse> uses, const IndexSet& actors);

/// Sampling of a clip's frames behind a lens. Quarters of pixels are known if there is an even number of samples along
/// each side and no picture is resampled for the lens.
[[nodiscard]] PixelSampling pixel_sampling(const Manifest& manifest, const LensDistortion& lens);

/// Sets planes of this size to 0. Memory is reused.
void clear_detail(int width_px, int height_px, SubpixelDetail& detail);

/// A pixel's detail from the means of its quarters: top left, top right, bottom left, bottom right. 0 if one is not
/// finite.
void set_detail(const std::array<float, 4>& quarters, int x, int y, SubpixelDetail& detail) noexcept;

/// Sums of the samples of a row's pixels, line by line: by quarter, if a pixel has an even number of lines.
class QuarterSums {
 public:
  /// @param factor  samples along each side of a pixel
  explicit QuarterSums(int factor);

  /// Starts a row of so many pixels.
  void begin(std::size_t pixels);
  /// Adds its next line of samples, `line` from 0.
  void add(int line, std::span<const float> samples);

  [[nodiscard]] float mean(std::size_t pixel) const noexcept;
  /// Their means: top left, top right, bottom left, bottom right. Of an even number of lines.
  [[nodiscard]] std::array<float, 4> quarters(std::size_t pixel) const noexcept;

 private:
  std::size_t parts_;                       ///< along each side of a pixel: 2, or 1
  std::size_t side_;                        ///< samples along each side of a part
  std::array<std::vector<float>, 2> sums_;  ///< upper and lower parts
};

/// Means of factor x factor samples, and their detail; `factor` is even.
void mean_quarters(const Plane<float>& fine, int factor, Plane<float>& means, SubpixelDetail& detail);

}  // namespace thermal
