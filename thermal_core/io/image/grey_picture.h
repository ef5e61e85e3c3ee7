#pragma once

#include "io/image/grey_plane.h"
#include "io/system/files.h"

namespace thermal {

/// Whether a file is read as a picture of grey levels: .png, .jpg, .jpeg, .tif or .tiff, in any case.
[[nodiscard]] bool is_grey_picture(const Path& file);

/// Reads a picture of grey levels of 8 or 16 bits. Colours of which all channels differ by at most kMostGreyTint, as in
/// a grey JPEG stored in colour, count as grey: their first channel is used. Alpha is dropped. DataError with the file
/// for other colours, other depths, damaged pictures and more than 256 million pixels; IoError if it cannot be read.
[[nodiscard]] GreyPicture read_grey_picture(const Path& file);

}  // namespace thermal
