#pragma once

#include <cstddef>
#include <vector>

#include "scene/baked_scene.h"

namespace thermal {

/// The highest surfaces above the middles of cells x cells squares, [row of y, column of x], from south and west; minus
/// infinity where there is none.
struct TopHeights {
  std::vector<float> ground_m;  ///< of ground and waters
  std::vector<float> plants_m;
};

/// Of the square of size_m around the origin, by projecting every triangle: exact to single precision, without gaps
/// between triangles that share an edge. The same bits for any number of threads.
[[nodiscard]] TopHeights top_heights(const BakedScene& scene, double size_m, std::size_t cells);

}  // namespace thermal
