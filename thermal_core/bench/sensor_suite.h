#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// Speed and error of everything between radiance and pictures on a 640 x 512 frame: every stage alone, the
/// generators of 1/f noise against each other, and the whole camera. One thread, fixed seeds. The error of each stage
/// is measured before its time.
[[nodiscard]] std::vector<StageRow> run_sensor_suite();

}  // namespace thermal
