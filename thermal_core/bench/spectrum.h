#pragma once

#include <functional>
#include <vector>

namespace thermal {

/// Power spectral density of a process [1/Hz], one-sided, at a frequency [Hz].
using Density = std::function<double(double frequency_hz)>;

/// Mean of the periodograms of many series, Hann window, one-sided [1/Hz]: value k belongs to k rate /
/// length. Every series has the same length, a power of two.
[[nodiscard]] std::vector<double> mean_periodogram(const std::vector<std::vector<float>>& series,
                                                   double rate_hz);

}  // namespace thermal
