#pragma once

#include "dataset/exports/plan.h"

namespace thermal {

/// Ultralytics' YOLO layout: images/SPLIT/NAME.png, labels/SPLIT/NAME.txt beside it, data.yaml. A line a label: class
/// (from 0, in the order of the categories), then centre and size of the box, cut at the border, as fractions of the
/// picture's sides, eight decimals: boxes come back within 1e-3 px up to 60,000 px. A picture without labels has an
/// empty file. `folder` is the absolute path that data.yaml tells.
[[nodiscard]] ExportPlan plan_yolo(const ExportInput& input, const std::string& folder);

/// Why YOLO's files can't hold a label; empty if they can.
[[nodiscard]] std::string why_not_in_yolo(const LabelSet& set, const Label& label);

}  // namespace thermal
