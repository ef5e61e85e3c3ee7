#pragma once

#include <string>

#include "io/system/files.h"

namespace thermal {

/// Encodes a picture of any format as a JPEG for viewing; wider than `most_px` it is scaled down. One channel of more
/// than 8 bits, such as temperatures, is stretched from its 0.5 % point (black) to its 99.5 % point (white). IoError if
/// it cannot be read, DataError if it is damaged.
[[nodiscard]] std::string as_jpeg(const Path& picture, int most_px);

}  // namespace thermal
