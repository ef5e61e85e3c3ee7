#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/lens_distortion.h"
#include "scene/manifest.h"
#include "sensor/round_kernel.h"
#include "sensor/subpixel_detail.h"

namespace thermal {

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
