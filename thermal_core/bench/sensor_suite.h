#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Speed beside error of everything between radiance and pictures on a 640 x 512 frame: every stage alone,
/// the generators of 1/f noise against each other, and the whole camera. One thread, seeds fixed. Every error
/// is measured before its stage is timed.
[[nodiscard]] std::vector<StageRow> run_sensor_suite();

}  // namespace thermal
