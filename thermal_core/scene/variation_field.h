#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace thermal {

/// A fractal field over the ground: mean 0, variance 1, the same value at the same place in every frame.
/// Octaves of smooth noise from the correlation length down to a sixteenth of it; each is a function of
/// (seed, place), the whole repeats after sixteen correlation lengths. What is smaller than a pixel's footprint
/// is averaged away, so that the picture does not sparkle when the camera moves.
class VariationField {
 public:
  explicit VariationField(std::uint32_t seed);

  /// Values at places, each averaged over about a footprint. All in correlation lengths: |x| and |y| below 1e5,
  /// footprint >= 0. A footprint of sixteen and more gives 0, the mean, and so do places further out, negative
  /// footprints and NaN.
  /// All spans are of one length.
  void sample(std::span<const float> x, std::span<const float> y, std::span<const float> footprint,
              std::span<float> value) const noexcept;

  /// The same for one place.
  [[nodiscard]] float sample(float x, float y, float footprint) const noexcept {
    float value = 0;
    sample({&x, 1}, {&y, 1}, {&footprint, 1}, {&value, 1});
    return value;
  }

 private:
  /// Pictures of the field, one after another, each half the size of the one before, down to a single texel.
  std::vector<std::int32_t> texels_;
};

}  // namespace thermal
