#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"
#include "io/image/module/tiff_library.h"

namespace thermal::pictures {
namespace {

/// fault() of base, to which this module is not linked.
[[noreturn]] void refuse(const std::string& what, const std::string& rule) {
  throw DataError(fmt::format("{}; expected {}", what, rule));
}

void check_depth(const OIIO::ImageSpec& spec) {
  const auto type = static_cast<OIIO::TypeDesc::BASETYPE>(spec.format.basetype);
  if (type != OIIO::TypeDesc::UINT8 && type != OIIO::TypeDesc::UINT16)
    refuse(fmt::format("pixels = {}", spec.format.c_str()), "grey of 8 or 16 bits");
}

/// The first colour channel; DataError if the others differ from it.
std::uint16_t grey_of(const std::uint16_t* pixel, int channels, int tint) {
  const auto [least, most] = std::minmax_element(pixel, pixel + (channels < 3 ? 1 : 3));
  if (*most - *least > tint) refuse("pixels = colours", "grey levels");
  return pixel[0];
}

}  // namespace

GreyPicture read_grey(const Path& file) {
  const auto in = open_picture(file);
  const OIIO::ImageSpec spec = in->spec();
  check_depth(spec);
  check_is_single(file);
  const int channels = spec.nchannels < 3 ? 1 : 3;
  std::vector<std::uint16_t> samples(static_cast<std::size_t>(spec.image_pixels()) *
                                     static_cast<std::size_t>(channels));
  read_channels(*in, file, channels, OIIO::TypeDesc::UINT16, samples.data());
  const int bits = spec.format == OIIO::TypeDesc::UINT8 ? 8 : 16;
  const int scale = bits == 8 ? 257 : 1;  // OpenImageIO maps 255 of 8 bits to 65535 of 16
  GreyPicture picture = {.levels = Plane<std::uint16_t>(spec.width, spec.height), .bits = bits};
  const auto out = picture.levels.pixels();
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::uint16_t* pixel = &samples[k * static_cast<std::size_t>(channels)];
    out[k] = static_cast<std::uint16_t>(grey_of(pixel, channels, kMostGreyTint * 257) / scale);
  }
  return picture;
}

}  // namespace thermal::pictures
