#pragma once

#include <chrono>

#include "analysis/balance/program.h"

namespace thermal {

/// When a search must end.
class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  /// Not negative.
  [[nodiscard]] double left_s() const {
    const std::chrono::duration<double> left = end_ - Clock::now();
    return left.count() > 0 ? left.count() : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

/// Searches for a solution to within a gap, from frames that meet the bounds of the classes. Returns the best found
/// by the deadline and the proven bound.
[[nodiscard]] BalanceResult search_balance(const BalanceProgram& program,
                                           std::vector<std::vector<std::int64_t>> taken, double gap,
                                           const Deadline& deadline);

}  // namespace thermal
