#pragma once

#include <string>
#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// What a step of the converter costs a frame, and what the machine would allow.
struct ConvertRow {
  std::string group;
  std::string name;
  double ms = 0;           ///< a frame
  double mb_per_s = 0;     ///< of what goes in, 10^6 bytes
  std::string limit;       ///< what it is held against, measured in the same run; empty: nothing
  double times_limit = 0;  ///< how many times as long it takes as that
  std::string bound;       ///< of a whole: what keeps it from being faster
  std::vector<Figure> figures = {};
};

}  // namespace thermal
