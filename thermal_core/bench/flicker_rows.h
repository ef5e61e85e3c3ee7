#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// White and 1/f noise with a knee of 0.5 Hz, both together: the sensor's processes at several rates, and a bank of
/// Ornstein-Uhlenbeck processes that are stepped in every frame. worst_db: of the designed spectrum against
/// 1 + knee / f, from 3e-3 Hz to Nyquist; measured_db: the same of the spectrum measured from 128 pixels and 32768
/// frames, in bands of an eighth of a decade from 0.01 to 10 Hz or 0.8 of Nyquist (the lowest scatter by 0.2 dB);
/// variance_sigma: of all pixels after 8 frames against the design.
[[nodiscard]] std::vector<StageRow> flicker_rows();

}  // namespace thermal
