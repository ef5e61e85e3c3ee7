#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "labels/instances.h"

namespace thermal {

/// Mean of a picture over an actor's pixels, and over what surrounds it.
struct TargetMeans {
  double target = 0;
  std::optional<double> ring;  ///< empty where there is no pixel to take it from
};

/// Means for each instance, in their order. The ring is what lies outside the actor's box grown by kGuardPx on every
/// side, which leaves room for blur, and inside the box grown by ring_px() more, as far as it is in the picture and
/// belongs to none of the instances. Masks are of the picture's size. Sums in double precision, in an order that
/// depends on the labels alone.
[[nodiscard]] std::vector<TargetMeans> target_means(const Plane<float>& picture,
                                                    std::span<const Instance> instances);

inline constexpr int kGuardPx = 2;

/// Width of the ring [px]: half of the box's larger side, rounded up, and at least 4.
[[nodiscard]] int ring_px(const PixelBox& box) noexcept;

}  // namespace thermal
