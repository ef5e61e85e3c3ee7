#pragma once

#include <vector>

#include "bench/sensor_scene.h"

namespace thermal {

/// Speed and error of labelling a 640 x 512 frame with 50 actors, a third of them behind trunks: every stage alone
/// and all together, on one thread. wrong_px: pixels that differ between the plane and a mask decoded from its text;
/// worst_visibility: against a count of every pixel; worst_mk: contrast against the definition in double precision
/// with the exact inverse of Planck's law; labels: their number; bytes: of their text.
[[nodiscard]] std::vector<StageRow> run_labels_suite();

}  // namespace thermal
