#pragma once

#include "base/image.h"

namespace thermal {

/// Differences between the quarters of each pixel [W m^-2 sr^-1]. With the pixel's mean m, its quarters are, from the
/// top left to the bottom right, m - across - down + crossed, m + across - down - crossed, m - across + down - crossed
/// and m + across + down + crossed. 0 where a pixel has one value. Empty planes: no subpixel data.
struct SubpixelDetail {
  Plane<float> across;
  Plane<float> down;
  Plane<float> crossed;

  [[nodiscard]] bool empty() const noexcept { return across.empty(); }
};

}  // namespace thermal
