#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/instances.h"

namespace thermal {

/// Mean of a picture over an actor's pixels, and over its surroundings.
struct TargetMeans {
  double target = 0;
  std::optional<double> ring;  ///< empty without such pixels
};

/// Means for each instance, in their order. The ring lies outside the actor's box grown by kGuardPx on every side, a
/// margin for blur, and inside that box grown by another ring_px(); it excludes pixels outside the picture and pixels
/// of any instance. Masks have the picture's size. Sums are in double precision, in an order that depends on the
/// labels alone.
[[nodiscard]] std::vector<TargetMeans> target_means(const Plane<float>& picture,
                                                    std::span<const Instance> instances);

/// Width of the gap between a box and its ring, which blur fills with the target's radiance.
inline constexpr int kGuardPx = 2;

/// Width of the ring [px]: half of the box's larger side, rounded up, and at least 4.
[[nodiscard]] int ring_px(const PixelBox& box) noexcept;

}  // namespace thermal
