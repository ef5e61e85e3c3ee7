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
#include "io/image/module/picture_input.h"

namespace thermal::pictures {
namespace {

/// Quantile of the finite pixels.
float quantile_of(std::vector<float> pixels, double share) {
  std::erase_if(pixels, [](float value) { return !std::isfinite(value); });
  if (pixels.empty()) return 0;
  const auto place = pixels.begin() + std::lround(share * static_cast<double>(pixels.size() - 1));
  std::nth_element(pixels.begin(), place, pixels.end());
  return *place;
}

/// Grey levels of temperatures, or of counts of more than 8 bits, which use a small part of their range: black and
/// white at the 0.5 and 99.5 % points.
OIIO::ImageBuf stretched(const OIIO::ImageBuf& picture) {
  constexpr double kTail = 0.005;
  std::vector<float> pixels(picture.spec().image_pixels());
  picture.get_pixels(OIIO::ROI(0, picture.spec().width, 0, picture.spec().height, 0, 1, 0, 1),
                     OIIO::TypeDesc::FLOAT, pixels.data());
  const float low = quantile_of(pixels, kTail);
  const float range = std::max(quantile_of(pixels, 1 - kTail) - low, 1e-6F);
  for (float& value : pixels)
    value = std::isfinite(value) ? std::clamp((value - low) / range, 0.F, 1.F) : 0.F;
  OIIO::ImageBuf grey(OIIO::ImageSpec(picture.spec().width, picture.spec().height, 1, OIIO::TypeDesc::UINT8));
  grey.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, pixels.data());
  return grey;
}

/// 8 bits, grey or red, green and blue.
OIIO::ImageBuf read_picture(const Path& file) {
  // Not an ImageBuf of the file: its size comes from a cache, which may be older than the file, and it would write out
  // of bounds.
  const auto in = open_picture(file);
  const OIIO::ImageSpec spec = in->spec();
  const bool deep = spec.nchannels == 1 && spec.format.basesize() > 1;
  const OIIO::TypeDesc type = deep ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  const int channels = spec.nchannels < 3 ? 1 : 3;
  OIIO::ImageBuf picture(OIIO::ImageSpec(spec.width, spec.height, channels, type));
  read_channels(*in, file, channels, type, picture.localpixels());
  return deep ? stretched(picture) : picture;
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
