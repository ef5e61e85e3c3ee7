#pragma once

#include <cstdint>
#include <span>

#include "scene/variation_field.h"

namespace thermal {

/// Moves points on the ground by a decimetre, by a fixed random field, so that borders in maps of half a metre become
/// uneven down to the pixel: fractal, of dimension 1.26, as the maps at their own scale. Temperatures are those of the
/// maps. The field repeats after 16 m, the warped ground does not.
class GroundWarp {
 public:
  explicit GroundWarp(std::uint32_t seed);

  /// Standard deviation of the displacement along each axis (estimate).
  static constexpr float kMoveM = 0.12F;

  /// Warps positions [m], with sizes of pixels there [m]; detail smaller than a pixel is averaged out. Positions that
  /// are not finite or beyond 100 km are unchanged. All spans have one length.
  void move(std::span<const float> x_m, std::span<const float> y_m, std::span<const float> footprint_m,
            std::span<float> moved_x_m, std::span<float> moved_y_m) const noexcept;

 private:
  VariationField east_;
  VariationField north_;
};

}  // namespace thermal
