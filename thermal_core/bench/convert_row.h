#pragma once

#include <string>
#include <vector>

#include "bench/stage_row.h"

namespace thermal {

/// Cost of a converter step per frame, and the limit set by the machine.
struct ConvertRow {
  std::string group;
  std::string name;
  double ms = 0;           ///< per frame
  double mb_per_s = 0;     ///< of input, 10^6 bytes
  std::string limit;       ///< lower bound measured in the same run; empty: none
  double times_limit = 0;  ///< its time / that of the limit
  std::string bound;       ///< bottleneck of a whole conversion
  std::vector<Figure> figures = {};
};

}  // namespace thermal
