#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace thermal {

/// Two neighbouring nodes of an evenly spaced axis, to interpolate between; with a single node, both are that node.
struct BetweenNodes {
  std::size_t low = 0;
  std::size_t high = 0;
  double share_of_high = 0;  ///< 0 to 1
};

/// @param place  in steps from the first node; clamped to the nodes
/// @param nodes  at least 1
[[nodiscard]] inline BetweenNodes between_nodes(double position, std::size_t nodes) noexcept {
  const auto last = static_cast<double>(nodes - 1);
  const double inside = std::clamp(position, 0.0, last);
  const double low = std::min(std::floor(inside), std::max(last - 1, 0.0));
  const auto number = static_cast<std::size_t>(low);
  return {.low = number, .high = std::min(number + 1, nodes - 1), .share_of_high = inside - low};
}

}  // namespace thermal
