#include "analysis/balance.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/balance_check.h"
#include "analysis/balance_search.h"
#include "analysis/nearest_bounds.h"
#include "base/error.h"

namespace thermal {

BalanceResult balance(const BalanceProgram& program, const BalanceOptions& options) {
  options.validate();
  const Deadline deadline(options.time_limit_s);
  NearestBounds nearest = nearest_bounds(program, options.time_limit_s);
  if (nearest.missed_by > 0)
    throw ConfigError(fmt::format("{}", fmt::join(bounds_not_met(program, nearest), "\n")));
  BalanceResult result = search_balance(program, std::move(nearest.taken), options.gap, deadline);
  const std::vector<std::string> faults = check_balance(program, result.solution);
  if (!faults.empty())
    throw Error(fmt::format("the solution violates the program: {}", fmt::join(faults, "; ")));
  return result;
}

}  // namespace thermal
