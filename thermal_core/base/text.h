#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// The candidate a person most likely meant by `word`: within two edits (insert, delete, replace, swap of
/// neighbours) and fewer than half its letters changed. Empty if there is none. Ties go to the first.
[[nodiscard]] std::string near_miss(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean "x"?", or nothing where there is no near miss.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"; past `most` names, "a, b, … (12 in all)".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 20);

/// The parts between separators, one more than there are of those; views into `text`.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// The number that the whole of a text is, as std::from_chars reads it: no blanks, no plus sign, and nothing where it
/// does not fit.
template <typename Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace thermal
