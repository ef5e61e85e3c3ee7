#include "base/cholesky.h"

#include <cassert>
#include <cmath>
#include <numeric>

namespace thermal {

std::vector<double> solve_positive_definite(std::vector<double> a, std::vector<double> b) {
  const std::size_t n = b.size();
  assert(a.size() == n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) rest -= a[i * n + k] * a[j * n + k];
      assert(i != j || rest > 0);
      a[i * n + j] = i == j ? std::sqrt(rest) : rest / a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
  return b;
}

std::vector<double> solve_with_sum(const std::vector<double>& a, const std::vector<double>& b,
                                   const std::vector<double>& of_sum) {
  std::vector<double> x = solve_positive_definite(a, b);
  const std::vector<double> per_excess = solve_positive_definite(a, of_sum);
  const auto sum_of = [&of_sum](const std::vector<double>& values) {
    return std::inner_product(of_sum.begin(), of_sum.end(), values.begin(), 0.0);
  };
  const double excess = (sum_of(x) - 1) / sum_of(per_excess);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] -= excess * per_excess[k];
  return x;
}

}  // namespace thermal
