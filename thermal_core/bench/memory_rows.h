#pragma once

#include <vector>

#include "bench/render_suite.h"

namespace thermal {

/// Memory and time of the engine `embree`: by plants, up to 1e6 on a terrain; by frames of a clip that are traced one
/// after another; by threads, one and two if there are as many cores.
[[nodiscard]] std::vector<RenderRow> memory_rows();

}  // namespace thermal
