#pragma once

#include "analysis/balance_program.h"

namespace thermal {

/// Solves the program to within a gap, and checks every constraint of the solution with check_balance(). ConfigError
/// for infeasible bounds, with the nearest feasible ones (nearest_bounds()), or if no solution is found in time. The
/// same program gives the same solution, unless the time limit was reached.
[[nodiscard]] BalanceResult balance(const BalanceProgram& program, const BalanceOptions& options);

}  // namespace thermal
