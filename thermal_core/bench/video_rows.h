#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// What cameras, links and recorders do to pictures behind the sensor.
[[nodiscard]] std::vector<StageRow> video_rows();

}  // namespace thermal
