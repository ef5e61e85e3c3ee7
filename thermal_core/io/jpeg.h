#pragma once

#include <string>

#include "io/files.h"

namespace thermal {

/// A picture of any format as a JPEG's bytes, for people to look at; wider than `most_px` it is made smaller.
/// IoError if it can't be read, DataError if it is damaged.
[[nodiscard]] std::string as_jpeg(const Path& picture, int most_px);

}  // namespace thermal
