#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace thermal {

Cancelled::Cancelled() : Error("stopped on request") {}

std::string fault(std::string_view where, std::string_view value, std::string_view unit,
                  std::string_view rule) {
  return fmt::format("{} = {}{}{}; expected {}", where, value, unit.empty() ? "" : " ", unit, rule);
}

std::string fault_lines(const std::vector<std::string>& faults, const std::string& name) {
  return fmt::format("{}: {}", name, fmt::join(faults, "\n" + name + ": "));
}

void require_range(std::string_view where, double value, std::string_view unit, double low, double high) {
  if (value >= low && value <= high) return;
  throw ConfigError(fault(where, fmt::format("{}", value), unit,
                          fmt::format("{} to {}{}{}", low, high, unit.empty() ? "" : " ", unit)));
}

void require_share_above_0(std::string_view where, double value) {
  if (value > 0 && value <= 1) return;
  throw ConfigError(fault(where, fmt::format("{}", value), "", "above 0 and at most 1"));
}

namespace {

/// Other sources of the core include <fmt/core.h> alone, which declares this function and takes a third of the time to
/// compile. Its body is here, with all that it calls.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): it points to a function
[[gnu::used]] std::string (*const kFormat)(fmt::string_view, fmt::format_args) = fmt::vformat;

}  // namespace

}  // namespace thermal
