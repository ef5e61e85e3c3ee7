#pragma once

#include <string>
#include <utility>
#include <vector>

namespace thermal {

/// Libraries the program runs with, and their versions.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace thermal
