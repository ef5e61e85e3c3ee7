#pragma once

#include <limits>

#include "scene/lens_distortion.h"

namespace thermal {

/// A rectangle of normalised coordinates; empty until points are added.
struct LensRange {
  LensPoint least = {.x = std::numeric_limits<double>::infinity(),
                     .y = std::numeric_limits<double>::infinity()};
  LensPoint most = {.x = -std::numeric_limits<double>::infinity(),
                    .y = -std::numeric_limits<double>::infinity()};

  /// Widens the range to hold a point; NaN changes nothing.
  void add(const LensPoint& point) noexcept;
  [[nodiscard]] bool is_empty() const noexcept { return !(least.x <= most.x && least.y <= most.y); }
};

/// The intersection of two ranges.
[[nodiscard]] LensRange common(const LensRange& a, const LensRange& b) noexcept;

/// A range that contains distort() of every point of a non-empty range, by interval arithmetic. It is wider than
/// necessary by a share of the range's size: 6 % for k1 = -0.2 at 0.4 from the axis.
[[nodiscard]] LensRange distort(const LensDistortion& lens, const LensRange& range) noexcept;

}  // namespace thermal
