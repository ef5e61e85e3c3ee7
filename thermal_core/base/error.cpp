#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace thermal {

Cancelled::Cancelled() : Error("stopped on request") {}

std::string fault(std::string_view where, std::string_view value, std::string_view unit,
                  std::string_view rule) {
  return fmt::format("{} = {}{}{}; expected {}", where, value, unit.empty() ? "" : " ", unit, rule);
}

void throw_faults(const std::vector<std::string>& faults, const std::string& name) {
  if (faults.empty()) return;
  throw ConfigError(fmt::format("{}: {}", name, fmt::join(faults, "\n" + name + ": ")));
}

}  // namespace thermal
