#pragma once

#include "io/system/files.h"
#include "labels/label_set.h"

namespace thermal {

/// Path of the file of a picture in untrusted labels. DataError if its name leads out of the labels' folder; IoError if
/// a link does, or if it is not a file.
[[nodiscard]] Path picture_of(const LabelSet& set, const LabelImage& image);

}  // namespace thermal
