#pragma once

#include "base/image.h"

namespace thermal {

/// How the quarters of each pixel differ [W m^-2 sr^-1]. With the pixel's mean m, its quarters are m - across - down +
/// crossed (top left), m + across - down - crossed, m - across + down - crossed and m + across + down + crossed (bottom
/// right). 0 where a pixel has one value. Empty planes: nothing is known within pixels.
struct SubpixelDetail {
  Plane<float> across;
  Plane<float> down;
  Plane<float> crossed;

  [[nodiscard]] bool empty() const noexcept { return across.empty(); }
};

}  // namespace thermal
