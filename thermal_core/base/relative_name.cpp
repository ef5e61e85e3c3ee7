#include "base/relative_name.h"

#include <algorithm>

#include "base/text.h"

namespace thermal {
namespace {

bool is_safe_part(std::string_view part) {
  return !part.empty() && part.size() <= RelativeName::kMostPartBytes && part != "." && part != ".." &&
         part.front() != '-';
}

/// Whether a text begins with a Windows drive, as "C:/x" and "C:x" do.
bool has_drive(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return text.size() >= 2 && is_letter(text[0]) && text[1] == ':';
}

}  // namespace

std::optional<RelativeName> RelativeName::of(std::string_view text) {
  if (text.size() > kMostBytes || printable(text) != text) return std::nullopt;
  std::string on_windows(text);
  std::ranges::replace(on_windows, '\\', '/');
  if (has_drive(text) || !std::ranges::all_of(split(on_windows, '/'), is_safe_part)) return std::nullopt;
  return RelativeName(text);
}

std::optional<RelativeName> RelativeName::part_of(std::string_view text) {
  if (text.find('/') != std::string_view::npos) return std::nullopt;
  return of(text);
}

}  // namespace thermal
