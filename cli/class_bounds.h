#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/balance.h"

namespace veldt {

/// Bounds as --per-class gives them: "LO:HI" for all classes, "small_animal=LO:HI" for one, which takes precedence.
/// Classes that are not listed have no bounds. Throws ConfigError for anything else.
[[nodiscard]] std::array<thermal::ClassBounds, thermal::kBalanceClasses> parse_class_bounds(
    const std::vector<std::string>& words);

}  // namespace veldt
