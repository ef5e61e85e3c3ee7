#pragma once

#include <vector>

#include "bench/measure.h"

namespace thermal {

/// Temperature to radiance and back, 8-14 um, 200 to 400 K: Veldt's and the published script's.
[[nodiscard]] std::vector<BenchRow> evaluator_rows();

}  // namespace thermal
