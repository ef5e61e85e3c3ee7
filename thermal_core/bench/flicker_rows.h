#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Generators of 1/f noise at 30 Hz: the sensor's pole-zero filter by poles per decade, and banks of
/// Ornstein-Uhlenbeck processes. slope_error and ripple_db: of the designed spectrum over three decades, 0.01 to 10
/// Hz; measured_slope_error: of the spectrum measured from 128 pixels and 32768 frames (its standard error is 0.004);
/// variance_sigma: of all pixels after 8 frames against the design.
[[nodiscard]] std::vector<StageRow> flicker_rows();

}  // namespace thermal
