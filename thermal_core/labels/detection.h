#pragma once

#include <cstddef>

#include "labels/label_set.h"

namespace thermal {

/// What a detector says it saw in one picture.
struct Detection {
  std::size_t image = 0;     ///< place in LabelSet::images
  std::size_t category = 0;  ///< place in LabelSet::categories
  LabelBox box;              ///< sides 0 or more; may reach out of the picture
  double score = 0;          ///< how sure it is; any finite number, higher is surer
};

}  // namespace thermal
