#pragma once

#include <memory>

#include <OpenImageIO/imageio.h>

#include "io/system/files.h"

namespace thermal::pictures {

/// Opens a PNG, JPEG or TIFF, which its first bytes say it is, and which claims no more than its file can hold
/// (check_claimed_size()). OpenImageIO's other decoders, two dozen for the formats of film and games, see no file: faults in
/// such decoders are found each year, and not mended in each Debian. DataError, without the file's name, if it is another
/// file or damaged.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_picture(const Path& file);

/// Reads the first channels of all pixels, as `type`, into `samples`, which has place for them. DataError, without the
/// file's name, if a part of the file cannot be decoded.
void read_channels(OIIO::ImageInput& in, const Path& file, int channels, OIIO::TypeDesc type, void* samples);

}  // namespace thermal::pictures
