#pragma once

#include "io/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Labels of a dataset of ours (a folder with dataset.json), of a BIRDSAI folder (with annotations/*.csv) or of a
/// COCO file (.json), with size classes.
/// DataError naming file and place for what cannot be: ids that come twice, boxes that are not numbers, images or
/// categories that no one told of, a dataset of which clips are not made (unless `unfinished_too`: then of what is
/// there); IoError if `source` is none of the three.
[[nodiscard]] LabelSet read_labels(const Path& source, bool unfinished_too = false);

}  // namespace thermal
