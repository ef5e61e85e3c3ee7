#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

/// The candidate most likely meant by `word`: within two edits (insert, delete, replace, swap of neighbours) that
/// change fewer than half its letters. Empty if there is none. Ties go to the first.
[[nodiscard]] std::string near_miss(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean "x"?", or empty without a near miss.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"; past `most` names, "a, b, … (12 in all)".
[[nodiscard]] std::string list_names(std::span<const std::string> names, std::size_t most = 20);

/// With ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string text);

/// The parts between separators, one more than there are of those; views into `text`.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Result of compare_names().
struct NameOrder {
  int sign = 0;            ///< below 0: the first name precedes the second
  bool by_number = false;  ///< two numbers in the same place are what differs first
};

/// Natural order: "frame 2" precedes "frame 10", regardless of leading zeros; other text is compared byte by byte.
/// Names that differ only in leading zeros are equal.
[[nodiscard]] NameOrder compare_names(std::string_view one, std::string_view other) noexcept;

/// Digits of a number that is certain to fit into 64 bits.
inline constexpr std::size_t kMostDigits = 18;

/// The number that the whole text represents, in the syntax of std::from_chars: no blanks, no plus sign. Empty if it
/// is not a number or out of range.
template <typename Number>
[[nodiscard]] std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

/// A text of any origin, such as a name in a file, made safe for terminals and JSON: one line of UTF-8. Line breaks
/// become "; "; other control characters and bytes that are not UTF-8 become `\x1b` and the like.
/// Source: The Unicode Standard 15.0, table 3-7 (well-formed UTF-8).
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace thermal
