#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"

namespace thermal::pictures {
namespace {

IoError font_fault(const Path& font, const std::string& reason) {
  return IoError(fmt::format("cannot use the font {}: {}", font.string(), reason));
}

}  // namespace

TextPicture draw_text(const Path& font, const std::string& ascii, int size_px) {
  const OIIO::ROI extent = OIIO::ImageBufAlgo::text_size(ascii, size_px, font.string());
  if (!extent.defined() || extent.width() <= 0 || extent.height() <= 0)
    throw font_fault(font, OIIO::has_error() ? OIIO::geterror() : "FreeType cannot draw with it");
  OIIO::ImageBuf buffer(OIIO::ImageSpec(extent.width(), extent.height(), 1, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::zero(buffer);
  const float white = 1;
  if (!OIIO::ImageBufAlgo::render_text(buffer, -extent.xbegin, -extent.ybegin, ascii, size_px, font.string(),
                                       OIIO::cspan<float>(white)))
    throw font_fault(font, buffer.geterror());
  TextPicture picture{.coverage = Plane<std::uint8_t>(extent.width(), extent.height()),
                      .baseline_px = -extent.ybegin};
  buffer.get_pixels(buffer.roi(), OIIO::TypeDesc::UINT8, picture.coverage.pixels().data());
  return picture;
}

}  // namespace thermal::pictures
