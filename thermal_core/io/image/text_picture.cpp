#include "io/image/text_picture.h"

#include <string_view>

#include "io/image/picture_module.h"

namespace thermal {
namespace {

/// Replaces each UTF-8 character that is not printable ASCII by "?".
std::string ascii_of(std::string_view text) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool inner = (byte & 0xC0U) == 0x80U;  // continuation byte
    if (!inner) ascii += byte >= ' ' && byte < 0x7F ? c : '?';
  }
  return ascii;
}

}  // namespace

TextPicture draw_text(const Path& font, const std::string& line, int size_px) {
  check_is_file(font);
  const std::string text = ascii_of(line);
  if (text.find_first_not_of(' ') == std::string::npos) return {};
  return picture_module().draw_text(font, text, size_px);
}

}  // namespace thermal
