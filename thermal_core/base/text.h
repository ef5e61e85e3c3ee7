#pragma once

#include <span>
#include <string>
#include <string_view>

namespace thermal {

/// The candidate a person most likely meant by `word`: within two edits (insert, delete, replace, swap of
/// neighbours) and fewer than half its letters changed. Empty if there is none. Ties go to the first.
[[nodiscard]] std::string near_miss(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean "x"?", or nothing where there is no near miss.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"; past `most` names, "a, b, … (12 in all)".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 20);

}  // namespace thermal
