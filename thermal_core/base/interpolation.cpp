#include "base/interpolation.h"

#include <numbers>

namespace thermal {

std::vector<double> fit_polynomial(const std::function<double(double)>& function, int terms) {
  const auto count = static_cast<std::size_t>(terms);
  // Chebyshev series from the values at the polynomials' roots.
  std::vector<double> series(count);
  for (int point = 0; point < terms; ++point) {
    const double angle = std::numbers::pi * (point + 0.5) / terms;
    const double value = function(std::cos(angle));
    for (std::size_t k = 0; k < count; ++k) {
      series[k] += (k == 0 ? 1.0 : 2.0) / terms * value * std::cos(static_cast<double>(k) * angle);
    }
  }
  // T_0 = 1, T_1 = x, T_k+1 = 2 x T_k - T_k-1, written out in powers of x.
  std::vector<double> powers(count);
  std::vector<double> before(count);
  std::vector<double> current(count);
  before[0] = 1;
  if (count > 1) current[1] = 1;
  powers[0] = series[0];
  for (std::size_t k = 1; k < count; ++k) {
    for (std::size_t power = 0; power < count; ++power) powers[power] += series[k] * current[power];
    std::vector<double> next(count);
    for (std::size_t power = 0; power < count; ++power) {
      next[power] = (power > 0 ? 2 * current[power - 1] : 0) - before[power];
    }
    before = current;
    current = next;
  }
  return powers;
}

}  // namespace thermal
