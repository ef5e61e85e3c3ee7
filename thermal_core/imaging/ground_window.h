#pragma once

#include <cstddef>

#include "scene/ground_maps.h"
#include "scene/manifest.h"

namespace thermal {

/// A rectangle of the cells of ground maps: [first, first + count) along x and y.
struct GroundWindow {
  std::size_t first_x = 0;
  std::size_t first_y = 0;
  std::size_t width = 0;
  std::size_t height = 0;

  [[nodiscard]] bool operator==(const GroundWindow&) const = default;
};

/// The cells that a clip may show, with a margin for interpolation: at least one cell; all cells if a frame has no pose
/// or shows the horizon.
[[nodiscard]] GroundWindow window_of(const GroundMaps& maps, const Manifest& manifest);

}  // namespace thermal
