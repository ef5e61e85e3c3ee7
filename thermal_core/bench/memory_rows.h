#pragma once

#include <vector>

#include "bench/render_suite.h"

namespace thermal {

/// Peak of this process's memory above its use when this object was created, after unused memory was returned to the
/// system. Of two such objects, only the younger one measures.
class PeakMemory {
 public:
  PeakMemory();

  /// [MB]; NaN where the system cannot reset its peak (/proc/self/clear_refs).
  [[nodiscard]] double grown_mb() const;

 private:
  double before_mb_ = 0;
};

/// Memory and time of the engine `embree`: by plants, up to 1e6 on a terrain; by frames of a clip that are traced one
/// after another; by threads, one and two if there are as many cores.
[[nodiscard]] std::vector<RenderRow> memory_rows();

}  // namespace thermal
