#pragma once

#include <OpenImageIO/imageio.h>

#include "io/system/files.h"

namespace thermal::pictures {

/// DataError, without the file's name, for a picture of more pixels than ReadLimits has, or of more bytes than a file
/// of this length can hold, in its pixels or in one of its tiles or strips; and for volumes. To be called before memory
/// is allocated.
void check_claimed_size(const OIIO::ImageSpec& spec, const Path& file);

}  // namespace thermal::pictures
