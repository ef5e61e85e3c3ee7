#include "bench/spectrum.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace thermal {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// Discrete Fourier transform in place, radix 2.
void transform(std::vector<Complex>& values) {
  const std::size_t length = values.size();
  for (std::size_t i = 1, j = 0; i < length; ++i) {  // into bit-reversed order
    std::size_t bit = length / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  std::vector<Complex> turns(length / 2);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    turns[i] = std::polar(1.0, -2 * pi * static_cast<double>(i) / static_cast<double>(length));
  }
  for (std::size_t half = 1; half < length; half *= 2) {
    for (std::size_t begin = 0; begin < length; begin += 2 * half) {
      for (std::size_t i = 0; i < half; ++i) {
        const Complex odd = values[begin + half + i] * turns[i * (length / (2 * half))];
        values[begin + half + i] = values[begin + i] - odd;
        values[begin + i] += odd;
      }
    }
  }
}

}  // namespace

std::vector<double> mean_periodogram(const std::vector<std::vector<float>>& series, double rate_hz) {
  const std::size_t length = series.front().size();
  assert(std::has_single_bit(length));
  std::vector<double> mean(length / 2);
  std::vector<Complex> values(length);
  for (const std::vector<float>& one : series) {
    for (std::size_t i = 0; i < length; ++i) {
      const double turns = static_cast<double>(i) / static_cast<double>(length);
      values[i] = static_cast<double>(one[i]) * (0.5 - 0.5 * std::cos(2 * pi * turns));
    }
    transform(values);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += std::norm(values[k]);
  }
  constexpr double kWindowPower = 3.0 / 8;  // mean square of the Hann window
  const double scale =
      2 / (rate_hz * kWindowPower * static_cast<double>(length) * static_cast<double>(series.size()));
  for (double& value : mean) value *= scale;
  return mean;
}

}  // namespace thermal
