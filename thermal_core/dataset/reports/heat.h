#pragma once

#include "io/json/file.h"
#include "labels/label_set.h"

namespace thermal {

/// Heat map of boxes in the picture, as JSON: `columns`, `rows`, and `boxes_over`, row by row the number of boxes over
/// each cell, averaged over all pictures of known size. Pictures of other sizes than the first's are scaled to it. {}
/// if no picture's size is known.
[[nodiscard]] Json heat_of(const LabelSet& set);

}  // namespace thermal
