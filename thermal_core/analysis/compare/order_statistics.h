#pragma once

#include <cstddef>
#include <vector>

namespace thermal {

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
