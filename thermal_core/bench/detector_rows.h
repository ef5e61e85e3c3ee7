#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// What the detector adds, stage by stage. *_sigma: the variance measured of independent values against the
/// one asked for, in its standard errors. Lag: largest difference from the exponential in the first frames
/// after a step of 100 K, as a share of the step; its time is what a camera takes longer with it. White
/// noise: fourth moment likewise, and the band of its spectrum that lies furthest off, of 32. Dead pixels:
/// how far the mean of the neighbours is from what the pixel would have seen.
[[nodiscard]] std::vector<StageRow> detector_rows();

}  // namespace thermal
