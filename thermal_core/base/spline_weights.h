#pragma once

#include <array>

namespace thermal {

/// Weights of a uniform cubic B-spline at a fraction between the middle two of four points. They are positive and sum
/// to 1.
[[nodiscard]] inline std::array<float, 4> spline_weights(double fraction) noexcept {
  const double t = fraction;
  const double u = 1 - t;
  return {static_cast<float>(u * u * u / 6), static_cast<float>((3 * t * t * t - 6 * t * t + 4) / 6),
          static_cast<float>((3 * u * u * u - 6 * u * u + 4) / 6), static_cast<float>(t * t * t / 6)};
}

}  // namespace thermal
