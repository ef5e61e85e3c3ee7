#pragma once

#include <string_view>

namespace thermal {

/// ConfigError with `where` unless `low` <= value <= `high`; NaN is outside.
void require_range(std::string_view where, double value, std::string_view unit, double low, double high);

/// ConfigError with `where` unless the value is above 0 and at most 1, as an emissivity is.
void require_share_above_0(std::string_view where, double value);

}  // namespace thermal
