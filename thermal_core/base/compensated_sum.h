#pragma once

#include <cmath>

namespace thermal {

/// Sum of many doubles that keeps what each addition rounds off (Neumaier, ZAMM 54, 39, 1974).
/// Relative error <= 2 u + n^2 u^2 for n terms of one sign, u = 2^-53: 2.2e-16 up to n = 1e7. NaN stays NaN.
class CompensatedSum {
 public:
  void add(double term) noexcept {
    const double sum = sum_ + term;
    const bool term_is_smaller = std::abs(sum_) >= std::abs(term);
    lost_ += term_is_smaller ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }

  [[nodiscard]] double value() const noexcept { return sum_ + lost_; }

 private:
  double sum_ = 0;
  double lost_ = 0;
};

}  // namespace thermal
