#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "io/image/module/functions.h"
#include "io/image/module/picture_input.h"
#include "io/image/picture_module.h"
#include "io/system/naming.h"

namespace thermal::pictures {
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
