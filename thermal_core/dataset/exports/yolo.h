#pragma once

#include "dataset/exports/plan.h"

namespace thermal {

/// Ultralytics' YOLO layout: images/SPLIT/NAME.png, labels/SPLIT/NAME.txt beside it, data.yaml. One line per label:
/// class (from 0, in the order of the categories), then centre and size of the box, clipped to the picture, as
/// fractions of the picture's size, with eight decimals: boxes are accurate to 1e-3 px up to 60,000 px. A picture
/// without labels has an empty file. `folder` is the absolute path written to data.yaml.
[[nodiscard]] ExportPlan plan_yolo(const ExportInput& input, const std::string& folder);

/// Why YOLO's format cannot represent a label; empty if it can.
[[nodiscard]] std::string why_not_in_yolo(const LabelSet& set, const Label& label);

}  // namespace thermal
