#pragma once

#include "dataset/exports/plan.h"

namespace thermal {

/// BIRDSAI's layout (Bondi et al., WACV 2020): annotations/CLIP.csv, images/CLIP/CLIP_0000000000.png, both in a folder
/// of each split where splits are asked for. Rows: frame, object_id, x_min, y_min, w, h, class, species, occluded,
/// noisy; no header, frames and pixels from 0, sorted by frame and object. Boxes are rounded outwards to whole pixels,
/// so that they hold what they held. The columns have no place for `ignore`, and such labels are there like others.
/// DataError if a label has no track, or two images of a clip have one frame index.
[[nodiscard]] ExportPlan plan_birdsai(const ExportInput& input);

/// Why BIRDSAI's rows can't hold a label; empty if they can.
[[nodiscard]] std::string why_not_in_birdsai(const LabelSet& set, const Label& label);

}  // namespace thermal
