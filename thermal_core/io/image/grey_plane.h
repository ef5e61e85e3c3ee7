#pragma once

#include <cstdint>

#include "base/image.h"

namespace thermal {

/// A picture of one channel as stored.
struct GreyPicture {
  Plane<std::uint16_t> levels;
  int bits = 8;  ///< of a level: 8 or 16
};

/// Levels of 8 bits by which the channels of a grey picture may differ, as after a conversion to luminance and back.
inline constexpr int kMostGreyTint = 2;

}  // namespace thermal
