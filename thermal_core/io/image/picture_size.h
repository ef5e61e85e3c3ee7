#pragma once

#include "io/system/files.h"

namespace thermal {

/// Size of a picture file.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

/// Size of a PNG, JPEG or TIFF, from its header. DataError with the file if it is none; IoError if it cannot be read.
[[nodiscard]] PictureSize read_picture_size(const Path& file);

}  // namespace thermal
