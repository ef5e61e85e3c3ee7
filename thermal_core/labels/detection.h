#pragma once

#include <cstddef>

#include "labels/label_set.h"

namespace thermal {

/// One detection by a detector in one picture.
struct Detection {
  std::size_t image = 0;     ///< index into LabelSet::images
  std::size_t category = 0;  ///< index into LabelSet::categories
  LabelBox box;              ///< width and height 0 or more; may extend beyond the picture
  double score = 0;          ///< confidence; any finite number, higher is more confident
};

}  // namespace thermal
