#pragma once

#include <functional>
#include <vector>

namespace thermal {

/// Power spectral density of a process [1/Hz], one-sided, at a frequency [Hz].
using Density = std::function<double(double frequency_hz)>;

/// Deviation of a density from 1/f between two frequencies.
struct FlickerFit {
  double slope_error = 0;  ///< of the least-squares line in logarithms, relative to -1
  double ripple_db = 0;    ///< largest distance from that line
};

/// Fits `points` densities evenly spaced in log frequency. Requires 0 < low_hz < high_hz, points > 2.
[[nodiscard]] FlickerFit fit_flicker(const Density& density, double low_hz, double high_hz, int points);

/// Mean of the periodograms of many series, Hann window, one-sided [1/Hz]: value k belongs to k rate /
/// length. Every series has the same length, a power of two.
[[nodiscard]] std::vector<double> mean_periodogram(const std::vector<std::vector<float>>& series,
                                                   double rate_hz);

}  // namespace thermal
