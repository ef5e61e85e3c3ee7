#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace thermal {

/// Quantile of sorted values, at least one, at a share from 0 to 1: one of the values, without interpolation.
[[nodiscard]] inline double nearest_rank(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

}  // namespace thermal
