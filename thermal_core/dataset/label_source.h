#pragma once

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Path of the file of a picture in untrusted labels. DataError if its name leads out of the labels' folder; IoError if
/// a link does, or if it is not a file.
[[nodiscard]] Path picture_of(const LabelSet& set, const LabelImage& image);

/// Labels of a Veldt dataset (a folder with dataset.json), of a BIRDSAI folder (with annotations/*.csv) or of a COCO
/// file (.json), with size classes.
/// DataError with file and location for invalid data: repeated ids, boxes that are not numbers, unknown images or
/// categories, a dataset with missing clips (unless `unfinished_too`: then of the existing ones); IoError if `source`
/// is none of the three.
[[nodiscard]] LabelSet read_labels(const Path& source, bool unfinished_too = false);

}  // namespace thermal
