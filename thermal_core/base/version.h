#pragma once

#include <string_view>

namespace thermal {

/// Version of the program and of the pixels it makes: the same config gives the same pixels as long as the first two
/// numbers do not change.
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace thermal
