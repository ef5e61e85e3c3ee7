#pragma once

#include <string>

#include "dataset/exports/plan.h"
#include "dataset/exports/segments.h"
#include "io/json/file.h"

namespace thermal {

/// The `bbox` of an annotation: x, y, width and height.
[[nodiscard]] Json bbox_of(const LabelBox& box);

/// A COCO file of labels from another kind of source: boxes without masks.
[[nodiscard]] std::string coco_text(const LabelSet& set);

/// The COCO file of each split. `text` is the whole file the labels were read from, `name` its name in messages: images
/// that are not in the set are removed with their annotations, as are videos without images; ids, categories, unknown
/// keys and masks stay unchanged. Images get the set's file names. `segments` converts masks.
[[nodiscard]] std::vector<std::string> split_coco(const ExportInput& input, const std::string& text,
                                                  const std::string& name, SegmentMaker* segments = nullptr);

/// Pictures in their folders, and split_coco() as annotations.json, or annotations/SPLIT.json with splits. `as_is`:
/// keep every byte unless `segments` changes a mask. Evaluators differ in the flags they support: pycocotools uses
/// iscrowd but not `ignore`, and counts ignored labels.
[[nodiscard]] ExportPlan plan_coco(const ExportInput& input, const std::string& text, const std::string& name,
                                   bool as_is, SegmentMaker* segments = nullptr);

}  // namespace thermal
