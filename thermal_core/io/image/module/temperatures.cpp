#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"
#include "io/image/module/tiff_library.h"

namespace thermal::pictures {
namespace {

/// GDAL's metadata of a TIFF, which OpenImageIO does not read; empty without.
std::string gdal_metadata(const Path& file) {
  constexpr std::uint32_t kTag = 42112;
  std::string reason;
  const Tiff tiff = open_tiff(file, reason);
  const TIFFField* field = tiff ? TIFFFindField(tiff.get(), kTag, TIFF_ANY) : nullptr;
  if (field == nullptr) return {};
  const char* text = nullptr;
  // libtiff gives the length of tags that it does not know; to GDAL, which may be in this process, this one is known.
  if (TIFFFieldPassCount(field) == 0)
    return TIFFGetField(tiff.get(), kTag, &text) == 1 && text != nullptr ? std::string(text) : std::string();
  std::uint32_t count = 0;
  if (TIFFFieldReadCount(field) != TIFF_VARIABLE2) return {};
  if (TIFFGetField(tiff.get(), kTag, &count, &text) != 1 || text == nullptr) return {};
  return {text, count};
}

/// The number of the first item of a role.
std::optional<double> item(std::string_view xml, std::string_view role) {
  const std::size_t found = xml.find(fmt::format("role=\"{}\">", role));
  if (found == std::string_view::npos) return std::nullopt;
  const std::string_view rest = xml.substr(xml.find('>', found) + 1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  const bool ends = error == std::errc() && end != rest.data() + rest.size() && *end == '<';
  return ends ? std::optional(number) : std::nullopt;
}

}  // namespace

StoredTemperatures read_temperatures(const Path& file) {
  const auto in = open_picture(file);
  const OIIO::ImageSpec spec = in->spec();
  const bool counts = spec.format == OIIO::TypeDesc::UINT16;
  if ((!counts && spec.format != OIIO::TypeDesc::FLOAT) || spec.nchannels != 1)
    throw DataError(fmt::format("pixels = {} x {}; expected one channel of 32-bit floats or 16-bit counts",
                                spec.nchannels, spec.format.c_str()));
  StoredTemperatures stored = {.values = Plane<float>(spec.width, spec.height), .counts = counts};
  read_channels(*in, file, 1, OIIO::TypeDesc::FLOAT, stored.values.pixels().data());
  if (counts)  // OpenImageIO takes 65535 for 1; the product is within 0.01 of a whole number
    for (float& value : stored.values.pixels()) value = std::round(value * 65535.0F);
  const std::string metadata = gdal_metadata(file);
  stored.scale = item(metadata, "scale");
  stored.offset = item(metadata, "offset").value_or(0);
  return stored;
}

}  // namespace thermal::pictures
