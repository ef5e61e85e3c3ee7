#pragma once

#include <memory>

#include <OpenImageIO/imageio.h>

#include "io/system/files.h"

namespace thermal::pictures {

/// Opens a picture that claims no more than its file can hold (check_claimed_size()). DataError, without the file's name, if
/// it is damaged.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_picture(const Path& file);

/// Reads the first channels of all pixels, as `type`, into `samples`, which has place for them. DataError, without the
/// file's name, if a part of the file cannot be decoded.
void read_channels(OIIO::ImageInput& in, const Path& file, int channels, OIIO::TypeDesc type, void* samples);

}  // namespace thermal::pictures
