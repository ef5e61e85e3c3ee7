#include "scene/ground_maps.h"

#include <algorithm>
#include <cmath>

namespace thermal {

std::size_t ground_map_cells(double size_m) noexcept {
  constexpr double kMostCells = 4096;
  constexpr double kWidestCellM = 1;
  return static_cast<std::size_t>(std::clamp(std::ceil(size_m / kWidestCellM), 1.0, kMostCells));
}

}  // namespace thermal
