#include "base/error.h"

#include <fmt/format.h>

namespace thermal {

Cancelled::Cancelled() : Error("stopped on request") {}

std::string fault(std::string_view where, std::string_view value, std::string_view unit,
                  std::string_view rule) {
  return fmt::format("{} = {}{}{}; expected {}", where, value, unit.empty() ? "" : " ", unit, rule);
}

}  // namespace thermal
