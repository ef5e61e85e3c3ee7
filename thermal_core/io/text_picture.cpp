#include "io/text_picture.h"

#include <string_view>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

IoError font_fault(const Path& font, const std::string& reason) {
  return IoError(fmt::format("cannot use the font {}: {}", font.string(), reason));
}

/// A "?" for each character of UTF-8 that is not printable ASCII.
std::string ascii_of(std::string_view text) {
  std::string ascii;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool inner = (byte & 0xC0U) == 0x80U;  // of a character that has begun
    if (!inner) ascii += byte >= ' ' && byte < 0x7F ? c : '?';
  }
  return ascii;
}

}  // namespace

TextPicture draw_text(const Path& font, const std::string& line, int size_px) {
  check_is_file(font);
  const std::string text = ascii_of(line);
  if (text.find_first_not_of(' ') == std::string::npos) return {};
  const OIIO::ROI extent = OIIO::ImageBufAlgo::text_size(text, size_px, font.string());
  if (!extent.defined() || extent.width() <= 0 || extent.height() <= 0)
    throw font_fault(font, OIIO::has_error() ? OIIO::geterror() : "FreeType cannot draw with it");
  OIIO::ImageBuf buffer(OIIO::ImageSpec(extent.width(), extent.height(), 1, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::zero(buffer);
  const float white = 1;
  if (!OIIO::ImageBufAlgo::render_text(buffer, -extent.xbegin, -extent.ybegin, text, size_px, font.string(),
                                       OIIO::cspan<float>(white)))
    throw font_fault(font, buffer.geterror());
  TextPicture picture{.coverage = Plane<std::uint8_t>(extent.width(), extent.height()),
                      .baseline_px = -extent.ybegin};
  buffer.get_pixels(buffer.roi(), OIIO::TypeDesc::UINT8, picture.coverage.pixels().data());
  return picture;
}

}  // namespace thermal
