#include "base/text.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace thermal {
namespace {

/// Optimal string alignment distance: edits and swaps of neighbours, no letter edited twice.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

/// Takes the digits at the front of a text, if there are any.
std::string_view take_digits(std::string_view& text) noexcept {
  const std::string_view digits = text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
  text.remove_prefix(digits.size());
  return digits;
}

/// Compares digit strings of any length as numbers.
int sign_of_difference(std::string_view one, std::string_view other) noexcept {
  one.remove_prefix(std::min(one.find_first_not_of('0'), one.size()));
  other.remove_prefix(std::min(other.find_first_not_of('0'), other.size()));
  if (one.size() != other.size()) return one.size() < other.size() ? -1 : 1;
  return one.compare(other);
}

}  // namespace

std::string near_miss(std::string_view word, std::span<const std::string> candidates) {
  constexpr std::size_t kMostEdits = 2;
  std::size_t fewest = kMostEdits + 1;
  std::string nearest;
  for (const std::string& candidate : candidates) {
    const std::size_t edits = edit_distance(word, candidate);
    if (edits < fewest && 2 * edits < candidate.size()) {
      fewest = edits;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string nearest = near_miss(word, candidates);
  return nearest.empty() ? std::string() : fmt::format("; did you mean \"{}\"?", nearest);
}

std::string list_names(std::span<const std::string> names, std::size_t most) {
  if (names.size() <= most) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{}, … ({} in all)", fmt::join(names.first(most), ", "), names.size());
}

std::string lower_case(std::string text) {
  for (char& letter : text)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

NameOrder compare_names(std::string_view one, std::string_view other) noexcept {
  const auto byte_of = [](char letter) { return static_cast<unsigned char>(letter); };
  while (!one.empty() && !other.empty()) {
    const char first = one.front();
    const char other_first = other.front();
    const std::string_view number = take_digits(one);
    const std::string_view other_number = take_digits(other);
    if (!number.empty() && !other_number.empty()) {
      const int sign = sign_of_difference(number, other_number);
      if (sign != 0) return {.sign = sign, .by_number = true};
      continue;
    }
    if (first != other_first) return {.sign = byte_of(first) < byte_of(other_first) ? -1 : 1};
    one.remove_prefix(1);
    other.remove_prefix(1);
  }
  return {.sign = static_cast<int>(other.empty()) - static_cast<int>(one.empty())};
}

namespace {

constexpr unsigned char kDelete = 0x7f;

bool is_between(unsigned char byte, unsigned char low, unsigned char high) {
  return byte >= low && byte <= high;
}

/// Lead bytes of a multi-byte character, the range of its second byte, and its length; further bytes are 80 to BF.
struct Form {
  unsigned char first_low;
  unsigned char first_high;
  unsigned char second_low;
  unsigned char second_high;
  std::size_t bytes;
};

constexpr std::array<Form, 8> kForms = {{{0xc2, 0xdf, 0x80, 0xbf, 2},
                                         {0xe0, 0xe0, 0xa0, 0xbf, 3},
                                         {0xe1, 0xec, 0x80, 0xbf, 3},
                                         {0xed, 0xed, 0x80, 0x9f, 3},
                                         {0xee, 0xef, 0x80, 0xbf, 3},
                                         {0xf0, 0xf0, 0x90, 0xbf, 4},
                                         {0xf1, 0xf3, 0x80, 0xbf, 4},
                                         {0xf4, 0xf4, 0x80, 0x8f, 4}}};

bool has_form(std::string_view text, const Form& form) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.size() < form.bytes || !is_between(byte(0), form.first_low, form.first_high) ||
      !is_between(byte(1), form.second_low, form.second_high))
    return false;
  for (std::size_t i = 2; i < form.bytes; ++i) {
    if (!is_between(byte(i), 0x80, 0xbf)) return false;
  }
  return true;
}

/// Length in bytes of the character at the start of a text; 0 if it is not a valid one, or a control character.
std::size_t shown_bytes(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < kDelete) return first >= ' ' ? 1 : 0;
  if (first == 0xc2 && text.size() > 1 && static_cast<unsigned char>(text[1]) < 0xa0)
    return 0;  // U+0080 to 9F
  for (const Form& form : kForms) {
    if (has_form(text, form)) return form.bytes;
  }
  return 0;
}

}  // namespace

std::string printable(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    if (bytes > 0) {
      shown += text.substr(0, bytes);
    } else {
      shown +=
          text.front() == '\n' ? "; " : fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    }
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return shown;
}

}  // namespace thermal
