#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"

namespace thermal {

/// A fractal field over the ground: mean 0, variance 1, the same value at the same place in every frame.
/// Octaves of smooth noise from the correlation length down to a sixteenth of it; each is a function of
/// (seed, place), the whole repeats after sixteen correlation lengths. What is smaller than a pixel's footprint
/// is averaged away, so that the picture does not sparkle when the camera moves.
class VariationField {
 public:
  explicit VariationField(std::uint32_t seed);

  /// Value at a place, averaged over about a footprint. All in correlation lengths: x and y of any finite size,
  /// footprint >= 0. A footprint past sixteen gives 0, the mean; NaN anywhere gives 0.
  [[nodiscard]] float sample(float x, float y, float footprint) const noexcept;

 private:
  std::vector<Plane<float>> levels_;  ///< each half the size of the one before
};

}  // namespace thermal
