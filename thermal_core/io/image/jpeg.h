#pragma once

#include <string>

#include "io/system/files.h"

namespace thermal {

/// Encodes a picture of any format as a JPEG for viewing; wider than `most_px` it is scaled down. One channel of more
/// than 8 bits, as of temperatures, is stretched from black at its 0.5 % point to white at its 99.5 % point. IoError if it
/// cannot be read, DataError if it is damaged.
[[nodiscard]] std::string as_jpeg(const Path& picture, int most_px);

}  // namespace thermal
