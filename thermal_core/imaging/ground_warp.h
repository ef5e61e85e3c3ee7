#pragma once

#include <cstdint>
#include <span>

#include "scene/variation_field.h"

namespace thermal {

/// Moves places on the ground by a decimetre, at random but always alike, so that the borders in maps of half a
/// metre become uneven down to the pixel: fractal, of dimension 1.26, as what the maps hold at their own scale. Nothing
/// gets warmer or colder than in the maps. The field repeats after 16 m, what it moves does not.
class GroundWarp {
 public:
  explicit GroundWarp(std::uint32_t seed);

  /// Standard deviation of a move along each axis (estimate).
  static constexpr float kMoveM = 0.12F;

  /// Places [m] and sizes of pixels there [m] to moved places; detail smaller than a pixel is averaged out. Places that
  /// are not finite or beyond 100 km stay. All spans have one length.
  void move(std::span<const float> x_m, std::span<const float> y_m, std::span<const float> footprint_m,
            std::span<float> moved_x_m, std::span<float> moved_y_m) const noexcept;

 private:
  VariationField east_;
  VariationField north_;
};

}  // namespace thermal
