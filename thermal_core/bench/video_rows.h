#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// Effects of cameras, links and recorders on pictures behind the sensor.
[[nodiscard]] std::vector<StageRow> video_rows();

}  // namespace thermal
