#pragma once

#include "dataset/exports/plan.h"

namespace thermal {

/// BIRDSAI's layout (Bondi et al., WACV 2020): annotations/CLIP.csv, images/CLIP/CLIP_0000000000.png, both in a
/// folder per split if there are splits. Rows: frame, object_id, x_min, y_min, w, h, class, species, occluded, noisy;
/// no header, frames and pixels from 0, sorted by frame and object. Boxes are rounded outwards to whole pixels, so
/// that they cover the same area. The format has no column for `ignore`; ignored labels are written like others.
/// DataError if a label has no track, two images of a clip have one frame index, or a clip has no order in time.
[[nodiscard]] ExportPlan plan_birdsai(const ExportInput& input);

/// Why BIRDSAI's format cannot represent a label; empty if it can.
[[nodiscard]] std::string why_not_in_birdsai(const LabelSet& set, const Label& label);

}  // namespace thermal
