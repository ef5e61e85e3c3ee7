#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Noise reduction and sharpening, which cameras have beside gain control.
[[nodiscard]] std::vector<StageRow> tone_rows();

}  // namespace thermal
