#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/balance.h"

namespace veldt {

/// Bounds from --per-class: "LO:HI" for all classes, "small_animal=LO:HI" for one, which takes precedence. Classes that
/// are not listed have no bounds. ConfigError for anything else.
[[nodiscard]] std::array<thermal::ClassBounds, thermal::kBalanceClasses> parse_class_bounds(
    const std::vector<std::string>& words);

}  // namespace veldt
