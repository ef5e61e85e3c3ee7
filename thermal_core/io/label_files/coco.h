#pragma once

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Labels of any COCO detection file; Veldt's own keys (videos, track_id, visibility …) are read if present. Pictures
/// without a video form a video per folder, or one named after the file if they have no folder. Size classes need
/// assign_size_classes(). Memory is that of the labels, not of a JSON tree.
/// DataError "FILE: annotations[3].bbox = …; expected …" for repeated ids, unknown images or categories, and boxes
/// that are not four finite numbers, empty or outside their picture; IoError if the file cannot be read.
[[nodiscard]] LabelSet read_coco(const Path& file);

}  // namespace thermal
