#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/balance.h"

namespace veldt {

/// Bounds as --per-class gives them: "LO:HI" for all classes, "small_animal=LO:HI" for one, which goes before. Classes
/// that nothing is said of may have any number of labels. ConfigError for what cannot be meant.
[[nodiscard]] std::array<thermal::ClassBounds, thermal::kBalanceClasses> parse_class_bounds(
    const std::vector<std::string>& words);

}  // namespace veldt
