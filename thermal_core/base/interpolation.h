#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace thermal {

/// Two neighbouring nodes of an evenly spaced axis, to interpolate between; with a single node, both are that node.
struct BetweenNodes {
  std::size_t low = 0;
  std::size_t high = 0;
  double share_of_high = 0;  ///< 0 to 1
};

/// @param position  in steps from the first node; clamped to the nodes
/// @param nodes  at least 1
[[nodiscard]] inline BetweenNodes between_nodes(double position, std::size_t nodes) noexcept {
  const auto last = static_cast<double>(nodes - 1);
  const double inside = std::clamp(position, 0.0, last);
  const double low = std::min(std::floor(inside), std::max(last - 1, 0.0));
  const auto number = static_cast<std::size_t>(low);
  return {.low = number, .high = std::min(number + 1, nodes - 1), .share_of_high = inside - low};
}

/// Weights of a uniform cubic B-spline at a fraction between the middle two of four points. They are positive and sum
/// to 1.
[[nodiscard]] inline std::array<float, 4> spline_weights(double fraction) noexcept {
  const double t = fraction;
  const double u = 1 - t;
  return {static_cast<float>(u * u * u / 6), static_cast<float>((3 * t * t * t - 6 * t * t + 4) / 6),
          static_cast<float>((3 * u * u * u - 6 * u * u + 4) / 6), static_cast<float>(t * t * t / 6)};
}

/// Coefficients, lowest power first, of the polynomial through a function's values at the Chebyshev points of
/// [-1, 1]: within a few times the error of the best one of its degree. `terms` from 1 to 16.
[[nodiscard]] std::vector<double> fit_polynomial(const std::function<double(double)>& function, int terms);

}  // namespace thermal
