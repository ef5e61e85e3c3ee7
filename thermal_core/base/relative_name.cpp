#include "base/relative_name.h"

#include <algorithm>

#include "base/printable.h"
#include "base/text.h"

namespace thermal {
namespace {

bool is_safe_part(std::string_view part) {
  return !part.empty() && part.size() <= RelativeName::kMostPartBytes && part != "." && part != ".." &&
         part.front() != '-';
}

}  // namespace

std::optional<RelativeName> RelativeName::of(std::string_view text) {
  if (text.size() > kMostBytes || printable(text) != text) return std::nullopt;
  if (!std::ranges::all_of(split(text, '/'), is_safe_part)) return std::nullopt;
  return RelativeName(text);
}

std::optional<RelativeName> RelativeName::part_of(std::string_view text) {
  if (text.find('/') != std::string_view::npos) return std::nullopt;
  return of(text);
}

}  // namespace thermal
