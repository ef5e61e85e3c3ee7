#pragma once

#include "io/json_file.h"
#include "labels/label_set.h"

namespace thermal {

/// Where boxes are in the picture, as JSON: `columns`, `rows`, and `boxes_over`, row by row how many boxes lie over each
/// cell, on average over all pictures whose size is told. Pictures of other sizes than the first's are stretched to it.
/// {} where no picture's size is told.
[[nodiscard]] Json heat_of(const LabelSet& set);

}  // namespace thermal
