#pragma once

#include <vector>

#include "analysis/balance/program.h"

namespace thermal {

/// Frames whose labels violate the bounds of the classes least.
struct NearestBounds {
  std::vector<std::vector<std::int64_t>> taken;  ///< frames, by video and type
  ClassCounts labels{};                          ///< in those frames
  std::int64_t missed_by = 0;  ///< sum over classes of labels below at_least or above at_most; 0: all are met
};

/// The frames that violate the bounds by the fewest labels in total: a separate integer program over the frame types
/// of all videos together, because bounds do not depend on videos. ConfigError if it is not solved in time.
[[nodiscard]] NearestBounds nearest_bounds(const BalanceProgram& program, double time_limit_s);

/// Which bounds of which classes cannot be met, and the nearest feasible ones; one line per class: "per-class
/// small_poacher: at least 500 requested, at most 312 possible with the other bounds".
[[nodiscard]] std::vector<std::string> bounds_not_met(const BalanceProgram& program,
                                                      const NearestBounds& nearest);

/// Solves the program to within a gap, and checks every constraint of the solution with check_balance(). ConfigError
/// for infeasible bounds, with the nearest feasible ones (nearest_bounds()), or if no solution is found in time. The
/// same program gives the same solution, unless the time limit was reached.
[[nodiscard]] BalanceResult balance(const BalanceProgram& program, const BalanceOptions& options);

}  // namespace thermal
