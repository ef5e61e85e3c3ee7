#pragma once

#include <memory>

#include <OpenImageIO/imageio.h>

#include "io/system/files.h"

namespace thermal::pictures {

/// Opens a PNG, JPEG or TIFF, recognized by its first bytes, which claims no more than its file can hold
/// (check_claimed_size()). OpenImageIO's other two dozen decoders are never used: vulnerabilities are found in them
/// each year, and not fixed in each Debian. DataError, without the file's name, for another or a damaged file.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_picture(const Path& file);

/// Reads the first channels of all pixels, as `type`, into `samples`, which must be large enough. DataError, without
/// the file's name, if a part of the file cannot be decoded.
void read_channels(OIIO::ImageInput& in, const Path& file, int channels, OIIO::TypeDesc type, void* samples);

}  // namespace thermal::pictures
