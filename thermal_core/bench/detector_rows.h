#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// The detector's effects, stage by stage. *_sigma: the measured variance of independent values against the specified
/// one, in its standard errors. Lag: largest difference from the exponential in the first frames after a step of 100
/// K, as a fraction of the step; its time is the extra time of a camera with lag. White noise: fourth moment
/// likewise, and the worst of 32 bands of its spectrum. Dead pixels: difference of the neighbours' mean from the true
/// signal of the pixel.
[[nodiscard]] std::vector<StageRow> detector_rows();

}  // namespace thermal
