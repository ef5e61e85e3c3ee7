#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace thermal {

/// The value at a share (0 to 1) of sorted values, of which there must be some: one of them, without interpolation.
[[nodiscard]] inline double nearest_rank(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

}  // namespace thermal
