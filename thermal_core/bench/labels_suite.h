#pragma once

#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Speed beside error of labelling a 640 x 512 frame with 50 actors, a third of them behind trunks: every stage alone
/// and all together, on one thread. wrong_px: pixels that a mask decoded from its text has and the plane has not, or
/// the other way round; worst_visibility: against counting pixel by pixel; worst_mk: contrast against the definition
/// in double precision with the exact inverse of Planck's law; labels: how many there are; bytes: of their text.
[[nodiscard]] std::vector<StageRow> run_labels_suite();

}  // namespace thermal
