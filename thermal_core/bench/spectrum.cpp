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

FlickerFit fit_flicker(const Density& density, double low_hz, double high_hz, int points) {
  std::vector<double> levels;  // ln(f S): flat for 1/f
  std::vector<double> places;  // ln f about their middle
  const double span = std::log(high_hz / low_hz);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double share = (i + 0.5) / points;
    const double frequency_hz = low_hz * std::exp(span * share);
    places.push_back(span * (share - 0.5));
    levels.push_back(std::log(frequency_hz * density(frequency_hz)));
    sum += levels.back();
  }
  double product = 0;
  double squares = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    product += places[i] * levels[i];
    squares += places[i] * places[i];
  }
  FlickerFit fit = {.slope_error = product / squares};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double rest = levels[i] - sum / points - fit.slope_error * places[i];
    fit.ripple_db = std::max(fit.ripple_db, 10 / std::numbers::ln10 * std::abs(rest));
  }
  return fit;
}

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
