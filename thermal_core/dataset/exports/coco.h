#pragma once

#include <string>

#include "dataset/exports/plan.h"

namespace thermal {

/// A COCO file of labels that come from another kind of source: boxes without masks.
[[nodiscard]] std::string coco_text(const LabelSet& set);

/// Pictures in their folders, and annotations.json; or annotations/SPLIT.json where splits are asked for. `text` is the
/// whole COCO file the labels were read from, `name` what it is called in faults: images that are not in the set and
/// their annotations are taken out, as are videos without images, and all else stays as it is: ids, categories, keys
/// that Veldt does not know, masks. Images get the set's file names. `as_is`: nothing is to change, not a byte.
/// Evaluators differ in what they know of: pycocotools heeds iscrowd but not `ignore`, and counts such labels.
[[nodiscard]] ExportPlan plan_coco(const ExportInput& input, const std::string& text, const std::string& name,
                                   bool as_is);

}  // namespace thermal
