#pragma once

#include <string>
#include <vector>

#include "analysis/balance.h"

namespace thermal {

/// What is wrong with a solution: each constraint of the program that it breaks, and its objective where that is not
/// what the variables give. Empty if nothing is. Counts whole numbers, from the videos and frames alone: it shares
/// nothing with the solver or the models it was given.
[[nodiscard]] std::vector<std::string> check_balance(const BalanceProgram& program,
                                                     const BalanceSolution& solution);

}  // namespace thermal
