#pragma once

#include <string>
#include <utility>
#include <vector>

namespace thermal {

/// Names and versions of the libraries that the program uses.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace thermal
