#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"
#include "io/image/module/tiff.h"

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

namespace {

constexpr std::uint32_t kMetadataTag = 42112;
constexpr std::uint32_t kNoDataTag = 42113;

/// Text of a GDAL tag in a TIFF, which OpenImageIO does not read; empty if there is none.
std::string text_of(const Path& file, std::uint32_t tag) {
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  const TIFFField* field = tiff ? TIFFFindField(tiff.get(), tag, TIFF_ANY) : nullptr;
  if (field == nullptr) return {};
  const char* text = nullptr;
  // libtiff passes the length of tags that are unknown to it; GDAL, if it is in this process, registers this one.
  if (TIFFFieldPassCount(field) == 0)
    return TIFFGetField(tiff.get(), tag, &text) == 1 && text != nullptr ? std::string(text) : std::string();
  std::uint32_t count = 0;
  if (TIFFFieldReadCount(field) != TIFF_VARIABLE2) return {};
  if (TIFFGetField(tiff.get(), tag, &count, &text) != 1 || text == nullptr) return {};
  return {text, count};
}

/// The text of the first item with a role; empty if there is none.
std::string_view item(std::string_view xml, std::string_view role) {
  const std::size_t found = xml.find(fmt::format("role=\"{}\">", role));
  if (found == std::string_view::npos) return {};
  const std::string_view rest = xml.substr(xml.find('>', found) + 1);
  return rest.substr(0, rest.find('<'));
}

/// GDAL_NODATA, which GDAL and others may end with blanks or a zero byte.
std::optional<double> no_data_in(const std::string& text) {
  constexpr std::string_view kBlanks(" \t\n\r\0", 5);
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return std::nullopt;
  const std::string number = text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
  if (const auto value = number_in<double>(number)) return value;
  throw DataError(fmt::format("GDAL_NODATA = \"{}\"; expected a number", number));
}

/// Reads the only channel, in its own type.
template <typename Number>
void read_values(OIIO::ImageInput& in, const Path& file, OIIO::TypeDesc type, Plane<float>& values) {
  std::vector<Number> stored(values.size());
  read_channels(in, file, 1, type, stored.data());
  std::ranges::transform(stored, values.pixels().begin(),
                         [](Number value) { return static_cast<float>(value); });
}

void read_values(OIIO::ImageInput& in, const Path& file, OIIO::TypeDesc type, StoredTemperatures& out) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT16:
      return read_values<std::uint16_t>(in, file, type, out.values);
    case OIIO::TypeDesc::INT16:
      return read_values<std::int16_t>(in, file, type, out.values);
    case OIIO::TypeDesc::FLOAT:
      return read_values<float>(in, file, type, out.values);
    default:
      return read_values<double>(in, file, type, out.values);
  }
}

}  // namespace

StoredTemperatures read_temperatures(const Path& file) {
  const auto in = open_picture(file);
  const OIIO::ImageSpec spec = in->spec();
  const auto is_one_of = [&spec](OIIO::TypeDesc::BASETYPE one, OIIO::TypeDesc::BASETYPE other) {
    return spec.format == one || spec.format == other;
  };
  const bool counts = is_one_of(OIIO::TypeDesc::UINT16, OIIO::TypeDesc::INT16);
  const bool floats = is_one_of(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::DOUBLE);
  if ((!counts && !floats) || spec.nchannels != 1)
    throw DataError(
        fmt::format("pixels = {} x {}; expected one channel of floats of 32 or 64 bits, or of 16-bit counts",
                    spec.nchannels, spec.format.c_str()));
  constexpr int kWhiteIsZero =
      0;  // then OpenImageIO would convert values to another order, as for grey levels
  if (spec.get_int_attribute("tiff:PhotometricInterpretation", 1) == kWhiteIsZero)
    throw DataError("PhotometricInterpretation = 0 (white is zero); expected 1: larger values are warmer");
  check_is_single(file);
  StoredTemperatures stored = {.values = Plane<float>(spec.width, spec.height), .counts = counts};
  read_values(*in, file, spec.format, stored);
  const std::string metadata = text_of(file, kMetadataTag);
  stored.scale = number_in<double>(item(metadata, "scale"));
  stored.offset = number_in<double>(item(metadata, "offset")).value_or(0);
  stored.unit = item(metadata, "unittype");
  stored.no_data = no_data_in(text_of(file, kNoDataTag));
  return stored;
}

}  // namespace thermal::pictures
