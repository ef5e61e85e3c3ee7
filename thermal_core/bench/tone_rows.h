#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Noise reduction and sharpening, the parts of a camera's processing besides gain control.
[[nodiscard]] std::vector<StageRow> tone_rows();

}  // namespace thermal
