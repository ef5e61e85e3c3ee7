#pragma once

#include <string>
#include <vector>

#include "analysis/balance_program.h"

namespace thermal {

/// Faults of a solution: each constraint of the program that it violates, and its objective if it does not follow
/// from the variables. Empty if it is correct. Exact integer arithmetic on the videos and frames alone: it shares no
/// code with the solver and its models.
[[nodiscard]] std::vector<std::string> check_balance(const BalanceProgram& program,
                                                     const BalanceSolution& solution);

}  // namespace thermal
