#pragma once

#include <vector>

#include "bench/measure.h"
#include "scene/material.h"

namespace thermal {

/// The terms of a physical scene, one by one and together, on a 640 x 512 frame; error against the same
/// formulas in double precision, pixel by pixel.
[[nodiscard]] std::vector<BenchRow> term_rows(const MaterialLibrary& materials);

/// A person seen from straight above at 122 m, a few pixels in size, supersampled 1 to 4 times per axis; error of the
/// affected pixels against 8 times.
[[nodiscard]] std::vector<BenchRow> supersample_rows(const MaterialLibrary& materials);

}  // namespace thermal
