#pragma once

#include <unordered_map>

#include "dataset/exports/plan.h"
#include "dataset/exports/segments.h"

namespace thermal {

/// Outlines of masks by the id of their label.
using Outlines = std::unordered_map<LabelId, Outline>;

/// Ultralytics' YOLO layout: images/SPLIT/NAME.png, labels/SPLIT/NAME.txt beside it, data.yaml. One line per label:
/// class (from 0, in the order of the categories), then centre and size of the box, clipped to the picture, as
/// fractions of the picture's size, with eight decimals: boxes are accurate to 1e-3 px up to 60,000 px. A picture
/// without labels has an empty file. `folder` is the absolute path written to data.yaml.
/// With `outlines`, by the label's id, a line has the class and the corners of the outline instead, with seven decimals:
/// within 0.003 px up to 60,000 px, so that a corner stays in its pixel.
[[nodiscard]] ExportPlan plan_yolo(const ExportInput& input, const std::string& folder,
                                   const Outlines* outlines = nullptr);

/// The outlines of all labels that YOLO's format can represent, from the COCO file `text`.
[[nodiscard]] Outlines yolo_outlines(const ExportInput& input, const std::string& text,
                                     const std::string& name, SegmentMaker& segments);

/// Why YOLO's format cannot represent a label; empty if it can.
[[nodiscard]] std::string why_not_in_yolo(const LabelSet& set, const Label& label);

}  // namespace thermal
