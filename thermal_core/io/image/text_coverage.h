#pragma once

#include <cstdint>

#include "base/image.h"

namespace thermal {

/// A line of text as a picture: how much of each pixel the letters cover, 0 to 255.
struct TextPicture {
  Plane<std::uint8_t> coverage;  ///< from the first letter's left edge; empty for text that shows nothing
  int baseline_px = 0;           ///< the row of `coverage` that letters stand on
};

}  // namespace thermal
