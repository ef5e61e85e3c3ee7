#include "base/ranges.h"

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {

void require_range(std::string_view where, double value, std::string_view unit, double low, double high) {
  if (value >= low && value <= high) return;
  throw ConfigError(fault(where, fmt::format("{}", value), unit,
                          fmt::format("{} to {}{}{}", low, high, unit.empty() ? "" : " ", unit)));
}

void require_share_above_0(std::string_view where, double value) {
  if (value > 0 && value <= 1) return;
  throw ConfigError(fault(where, fmt::format("{}", value), "", "above 0 and at most 1"));
}

}  // namespace thermal
