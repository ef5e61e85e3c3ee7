#pragma once

#include <memory>
#include <string>

#include <tiffio.h>

#include "io/system/files.h"

namespace thermal::pictures {

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;
using TiffOptions = std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)>;

/// Options with which libtiff prints nothing, and stores its last error in `reason`, which must outlive the file.
[[nodiscard]] TiffOptions quiet_options(std::string& reason);

/// Opens a file for reading; null, with the reason, if that fails.
[[nodiscard]] Tiff open_tiff(const Path& file, std::string& reason);

/// DataError, without the file's name, unless each strip or tile of the first picture can be decoded. OpenImageIO 2.4
/// accepts a deflated strip that ends early, and leaves its last pixels uninitialised.
void check_is_whole(const Path& file);

/// DataError, without the file's name, if a TIFF has more than one picture: pages, or a mask of pixels without a value.
/// Smaller copies, such as overviews and thumbnails, do not count. Files other than TIFF pass.
void check_is_single(const Path& file);

}  // namespace thermal::pictures
