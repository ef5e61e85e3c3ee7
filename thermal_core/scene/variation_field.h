#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace thermal {

/// A fractal field over the ground: mean 0, variance 1, with the same value at a point of the ground in every frame. It
/// sums octaves of smooth noise from the correlation length down to a sixteenth of it; each is a function of (seed,
/// point), and the field repeats after sixteen correlation lengths. Detail smaller than a pixel's footprint is averaged
/// out, so that the picture does not flicker when the camera moves.
class VariationField {
 public:
  explicit VariationField(std::uint32_t seed);

  /// Values at points, each averaged over approximately its footprint. All in correlation lengths: |x| and |y| below
  /// 1e5, footprint >= 0. A footprint of sixteen or more gives 0, the mean; so do points outside the domain, negative
  /// footprints and NaN. All spans have one length.
  void sample(std::span<const float> x, std::span<const float> y, std::span<const float> footprint,
              std::span<float> value) const noexcept;

  /// The same for one point.
  [[nodiscard]] float sample(float x, float y, float footprint) const noexcept {
    float value = 0;
    sample({&x, 1}, {&y, 1}, {&footprint, 1}, {&value, 1});
    return value;
  }

 private:
  /// Mip levels of the field, each half the size of the one before, down to a single texel.
  std::vector<std::int32_t> texels_;
};

}  // namespace thermal
