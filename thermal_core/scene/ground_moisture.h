#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/baked_scene.h"

namespace thermal {

/// How moist the ground is in the middles of cells x cells squares, [row of y, column of x], from south and west; 255
/// is saturated. The larger of two terms, both estimates: 1 in water and at its shore, falling by a factor of e every 4
/// m outwards; and up to 0.5 in hollows, in proportion to the rise of the land on two opposite sides, 30 m away, up to
/// 2 m. The foot of a slope is no hollow. `ground` has at least one cell.
[[nodiscard]] std::vector<std::uint8_t> ground_moisture(const BakedGround& ground, std::size_t cells);

/// Depth of the water in the middles of the same squares [m], 0 on land: height of the highest surface, ground or
/// water, above the ground. Empty without water.
[[nodiscard]] std::vector<float> water_depths_m(const BakedGround& ground, std::span<const float> highest_m,
                                                std::size_t cells);

}  // namespace thermal
