#pragma once

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Path of the file that holds a picture of labels, which anybody may have written. DataError if its name leads out of
/// the folder of the labels; IoError if a link does, or if it is no file.
[[nodiscard]] Path picture_of(const LabelSet& set, const LabelImage& image);

}  // namespace thermal
