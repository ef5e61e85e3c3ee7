#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.h"

/// An index plane drawn as text, one character per pixel: '.' is 0, a digit an index.
inline thermal::Plane<std::uint16_t> drawn(const std::vector<std::string>& rows) {
  thermal::Plane<std::uint16_t> plane(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < plane.height_px(); ++y) {
    for (int x = 0; x < plane.width_px(); ++x) {
      const char letter = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      plane.at(x, y) = letter == '.' ? std::uint16_t{0} : static_cast<std::uint16_t>(letter - '0');
    }
  }
  return plane;
}
