#include <cstdint>
#include <string>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "base/error.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"

namespace thermal::pictures {
namespace {

constexpr std::uintmax_t kMostPhotoBytes = std::uintmax_t{256} << 20;
constexpr std::size_t kMostTagBytes = 256;
constexpr int kMostTagNumbers = 16;

/// Empty: neither text nor a few numbers.
std::string text_of(const OIIO::ParamValue& tag) {
  if (tag.type() == OIIO::TypeDesc::STRING) return std::string(tag.get_ustring());
  const auto count = static_cast<int>(tag.type().basevalues()) * tag.nvalues();
  if (tag.type().basetype == OIIO::TypeDesc::STRING || count > kMostTagNumbers) return "";
  std::string text;
  for (int k = 0; k < count; ++k) text += fmt::format("{}{}", k == 0 ? "" : " ", tag.get_float_indexed(k));
  return text;
}

}  // namespace

PhotoTags read_tags(const Path& file) {
  const auto in = open_picture(file);
  if (std::filesystem::file_size(file) > kMostPhotoBytes)
    throw DataError(fmt::format("larger than {} MiB, the most that is read", kMostPhotoBytes >> 20));
  PhotoTags tags = {.size = {.width_px = in->spec().width, .height_px = in->spec().height}, .texts = {}};
  for (const OIIO::ParamValue& tag : in->spec().extra_attribs) {
    std::string text = text_of(tag);
    if (!text.empty() && text.size() <= kMostTagBytes) tags.texts[tag.name().string()] = std::move(text);
  }
  return tags;
}

}  // namespace thermal::pictures
