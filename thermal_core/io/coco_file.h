#pragma once

#include "io/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Labels of any COCO detection file; Veldt's own keys (videos, track_id, visibility …) are read where they are.
/// Pictures of no video are a video of their folder, or of the file where they are beside it. Sizes need assign_size_classes().
/// Memory is that of the labels, not that of the text's tree.
/// DataError "FILE: annotations[3].bbox = …; expected …" for ids that come twice, unknown images or categories, boxes
/// that are not four finite numbers, empty or outside their picture; IoError if it can't be read.
[[nodiscard]] LabelSet read_coco(const Path& file);

}  // namespace thermal
