#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// From radiance to pictures: counts, AGC mode by mode, and the whole camera. worst_mk: apparent temperature against
/// the exact inverse; worst_counts: 16-bit picture without noise against the same formulas in double precision, 0.5
/// being perfect; off_percent, worst_levels: pixels of the 8-bit picture that differ from those of a double-precision
/// AGC on unrounded temperatures, in a clip's second frame, 3 K warmer than its first.
[[nodiscard]] std::vector<StageRow> picture_rows();

}  // namespace thermal
