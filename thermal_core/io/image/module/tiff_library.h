#pragma once

#include <memory>
#include <string>

#include <tiffio.h>

#include "io/system/files.h"

namespace thermal::pictures {

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;
using TiffOptions = std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)>;

/// Options for a file with which libtiff prints nothing, and puts its last error into `reason`. That must outlive the file.
[[nodiscard]] TiffOptions quiet_options(std::string& reason);

/// Opens a file for reading; null, with the reason, if that cannot be done.
[[nodiscard]] Tiff open_tiff(const Path& file, std::string& reason);

/// DataError, without the file's name, unless each strip or tile of the first picture can be decoded. OpenImageIO 2.4 takes a
/// deflated strip that ends early for whole, and its last pixels are what was in memory.
void check_is_whole(const Path& file);

/// DataError, without the file's name, if a TIFF has more than one picture: pages, or a mask of pixels without a value. Smaller
/// copies, as of maps and thumbnails, are none. A file that is no TIFF passes.
void check_is_single(const Path& file);

}  // namespace thermal::pictures
