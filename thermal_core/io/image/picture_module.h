#pragma once

#include <string>

#include "io/image/pictures.h"
#include "io/system/files.h"

namespace thermal {

/// Functions that use OpenImageIO, libtiff and OpenCV's imgcodecs. These need 230 libraries, which take .3 s to load,
/// so they are in a module (io/pictures/) that is loaded on first use. Exceptions are those of the functions' callers.
struct PictureModule {
  /// As as_jpeg() in io/image/pictures.h, with faults of the file without its name.
  std::string (*as_jpeg)(const Path& picture, int most_px);
  PictureSize (*read_picture_size)(const Path& file);
  TextPicture (*draw_text)(const Path& font, const std::string& ascii, int size_px);
  std::string (*encode_picture)(const cv::Mat& bgr, PictureFormat format);
  /// As read_grey_picture(), with faults of the file without its name.
  GreyPicture (*read_grey)(const Path& file);
  StoredTemperatures (*read_temperatures)(const Path& file);
  PhotoTags (*read_tags)(const Path& file);
  std::string (*encode_kelvin_tiff)(const Plane<float>& picture, const TiffTags& tags);
  std::string (*encode_counts_tiff)(const Plane<std::uint16_t>& picture, const TiffTags& tags);
  std::string (*openimageio_version)();
};

/// The module, loaded by the first call. IoError if it is missing.
[[nodiscard]] const PictureModule& picture_module();

}  // namespace thermal
