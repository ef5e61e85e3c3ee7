#pragma once

#include <cstdint>
#include <vector>

#include "imaging/ground_window.h"

namespace thermal {

/// Fractal noise over the cells of a window: mean 0, variance 1, never repeated. It sums octaves of smooth noise from
/// the correlation length down to two cells, each 0.6 times as strong as the one before; a cell's value depends on
/// (seed, stream, cell) alone, whatever the window. Values are [row of y, column of x].
/// @param length_cells  correlation length in cells, > 0; below two cells nothing is left, and all values are 0
[[nodiscard]] std::vector<float> ground_noise(const GroundWindow& window, double length_cells,
                                              std::uint32_t seed, std::uint32_t stream);

}  // namespace thermal
