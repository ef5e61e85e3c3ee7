#pragma once

#include "io/system/files.h"

namespace thermal {

/// Of a picture file.
struct PictureSize {
  int width_px = 0;
  int height_px = 0;
};

/// Size of a picture of any common format, from its header. IoError with the file and the library's reason.
[[nodiscard]] PictureSize read_picture_size(const Path& file);

}  // namespace thermal
