#pragma once

#include <cstdint>

#include "base/image.h"

namespace thermal {

/// A rendered line of text: coverage of each pixel, 0 to 255.
struct TextPicture {
  Plane<std::uint8_t> coverage;  ///< from the first letter's left edge; empty for invisible text
  int baseline_px = 0;           ///< the row of `coverage` with the baseline
};

}  // namespace thermal
