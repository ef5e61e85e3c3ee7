#include "base/printable.h"

#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace thermal {
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
