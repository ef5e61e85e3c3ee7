#include <cstdint>
#include <string>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"
#include "io/image/picture_module.h"
#include "io/system/files.h"

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

namespace {

std::string encode_picture(const cv::Mat& bgr, PictureFormat format) {
  const bool png = format == PictureFormat::png;
  const std::vector<int> how =
      png ? std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, 9} : std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 92};
  std::vector<unsigned char> bytes;
  cv::imencode(png ? ".png" : ".jpg", bgr, bytes, how);
  return {bytes.begin(), bytes.end()};
}

PictureSize read_picture_size(const Path& file) {
  const auto in = naming(file, [&file] { return open_picture(file); });
  return {.width_px = in->spec().width, .height_px = in->spec().height};
}

std::string openimageio_version() {
  const int version = OIIO::openimageio_version();
  return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace

}  // namespace thermal::pictures

extern "C" const thermal::PictureModule kVeldtPictureModule;
const thermal::PictureModule kVeldtPictureModule = {
    .as_jpeg = thermal::pictures::as_jpeg,
    .read_picture_size = thermal::pictures::read_picture_size,
    .draw_text = thermal::pictures::draw_text,
    .encode_picture = thermal::pictures::encode_picture,
    .read_grey = thermal::pictures::read_grey,
    .read_temperatures = thermal::pictures::read_temperatures,
    .read_tags = thermal::pictures::read_tags,
    .encode_kelvin_tiff = thermal::pictures::encode_kelvin_tiff,
    .encode_counts_tiff = thermal::pictures::encode_counts_tiff,
    .openimageio_version = thermal::pictures::openimageio_version,
};
