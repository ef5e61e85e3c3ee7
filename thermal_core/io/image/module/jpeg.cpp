#include <algorithm>
#include <cmath>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"

namespace thermal::pictures {
namespace {

/// 8 bits, grey or red, green and blue.
OIIO::ImageBuf read_picture(const Path& file) {
  if (!std::filesystem::exists(file))
    throw IoError(fmt::format("cannot read {}: no such file", file.string()));
  OIIO::ImageBuf picture(file.string());
  if (!picture.read(0, 0, true, OIIO::TypeDesc::UINT8))
    throw DataError(fmt::format("{}: damaged: {}", file.string(), picture.geterror()));
  const int channels = picture.nchannels() < 3 ? 1 : 3;
  return picture.nchannels() == channels ? picture : OIIO::ImageBufAlgo::channels(picture, channels, {});
}

OIIO::ImageBuf at_most(OIIO::ImageBuf picture, int most_px) {
  const OIIO::ImageSpec& spec = picture.spec();
  if (spec.width <= most_px) return picture;
  const int height = std::max(1, static_cast<int>(std::lround(1.0 * spec.height * most_px / spec.width)));
  return OIIO::ImageBufAlgo::resize(picture, "", 0,
                                    OIIO::ROI(0, most_px, 0, height, 0, 1, 0, spec.nchannels));
}

}  // namespace

std::string as_jpeg(const Path& picture, int most_px) {
  const OIIO::ImageBuf image = at_most(read_picture(picture), most_px);
  OIIO::ImageSpec spec(image.spec().width, image.spec().height, image.nchannels(), OIIO::TypeDesc::UINT8);
  spec.attribute("CompressionQuality",
                 82);  // for noisy frames: half the bytes of quality 92; boxes are drawn separately
  std::vector<unsigned char> pixels(spec.image_bytes());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto out = OIIO::ImageOutput::create("jpeg");
  const bool written = image.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::UINT8, pixels.data()) && out &&
                       out->set_ioproxy(&memory) && out->open("picture.jpg", spec) &&
                       out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && out->close();
  if (!written)
    throw IoError(fmt::format("cannot encode a JPEG: {}", out ? out->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace thermal::pictures
