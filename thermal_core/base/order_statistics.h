#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace thermal {

/// Quantile of sorted values, at least one, at a share from 0 to 1: one of the values, without interpolation.
[[nodiscard]] inline double nearest_rank(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

/// Quantile of values, interpolated between neighbours (type 7 of Hyndman and Fan 1996); 0 without values.
/// @param share  0 to 1
[[nodiscard]] double quantile_of(std::vector<double> values, double share);

/// Median of values, likewise.
[[nodiscard]] double median_of(std::vector<double> values);

/// Arithmetic mean.
[[nodiscard]] double mean_of(const std::vector<double>& values);

/// Standard deviation with n - 1; 0 of fewer than two.
[[nodiscard]] double deviation_of(const std::vector<double>& values);

/// At most `most` of `count` indices, evenly spaced and increasing, the first among them.
[[nodiscard]] std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

}  // namespace thermal
