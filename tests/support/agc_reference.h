#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

/// The adaptive modes of the AGC again, in plain double precision, count by count and without histogram arrays: the
/// documentation of agc.h, implemented as directly as possible.
namespace agc_reference {

using Counts = thermal::Plane<std::uint16_t>;

/// Counts that the adaptive modes use, in order.
inline std::vector<int> measured(const Counts& ir16) {
  std::vector<int> counts;
  for (const std::uint16_t count : ir16.pixels()) {
    if (count != 0 && count != 65535) counts.push_back(count);
  }
  std::sort(counts.begin(), counts.end());
  return counts;
}

struct Limits {
  double low = 0;
  double high = 0;
};

/// The counts without a fraction of them at either end.
inline Limits without_tails(const std::vector<int>& sorted, double tail_percent) {
  const auto dropped = static_cast<std::size_t>(tail_percent / 100 * static_cast<double>(sorted.size()));
  return {.low = static_cast<double>(sorted[dropped]),
          .high = static_cast<double>(sorted[sorted.size() - 1 - dropped])};
}

/// Limits of mode percentile for a single frame.
inline Limits percentile_limits(const thermal::AgcParameters& parameters, double counts_per_netd,
                                const Counts& ir16) {
  const Limits tails = without_tails(measured(ir16), parameters.tail_percent);
  const double narrowest = 255 / parameters.max_gain_dn_per_netd * counts_per_netd;
  const double missing = std::max(0.0, narrowest - (tails.high - tails.low));
  return {.low = tails.low - missing / 2, .high = tails.high + missing / 2};
}

inline double linear_level(const Limits& limits, double count) {
  return std::clamp(255 * (count - limits.low) / (limits.high - limits.low), 0.0, 255.0);
}

/// The curve of mode plateau for a single frame: level at the lower edge of each bin, by bin.
inline std::vector<double> plateau_levels(const thermal::AgcParameters& parameters, double counts_per_netd,
                                          int bin_counts, const Counts& ir16) {
  const std::vector<int> sorted = measured(ir16);
  const Limits tails = without_tails(sorted, parameters.tail_percent);
  const double plateau = std::max(1.0, parameters.plateau_percent / 100 * static_cast<double>(sorted.size()));
  const double steepest = parameters.max_gain_dn_per_netd * bin_counts / counts_per_netd;
  std::map<int, double> pixels;  // by bin
  for (const int count : sorted) {
    if (count >= tails.low && count <= tails.high) pixels[count / bin_counts] += 1;
  }
  double sum = 0;
  for (auto& [bin, number] : pixels) sum += number = std::min(number, plateau);
  const int first = static_cast<int>(tails.low) / bin_counts;
  const int last = static_cast<int>(tails.high) / bin_counts;
  const auto rise = [&](int bin) {
    if (bin < first || bin > last) return steepest;
    return pixels.count(bin) == 0 ? 0 : std::min(steepest, 255 * pixels[bin] / sum);
  };
  double total = 0;
  for (int bin = first; bin <= last; ++bin) total += rise(bin);
  const int bins = (65536 + bin_counts - 1) / bin_counts;
  std::vector<double> levels(static_cast<std::size_t>(bins) + 1);
  double up = (255 - total) / 2;
  double down = up;
  for (int bin = first; bin <= bins; up += rise(bin++))
    levels[static_cast<std::size_t>(bin)] = std::min(255.0, up);
  for (int bin = first - 1; bin >= 0; --bin) {
    down -= rise(bin);
    levels[static_cast<std::size_t>(bin)] = std::max(0.0, down);
  }
  return levels;
}

/// Linear interpolation between the edges of bins.
inline double level_between(const std::vector<double>& levels, int bin_counts, int count) {
  const auto bin = static_cast<std::size_t>(count / bin_counts);
  const double share = static_cast<double>(count % bin_counts) / bin_counts;
  return levels[bin] + share * (levels[bin + 1] - levels[bin]);
}

}  // namespace agc_reference
