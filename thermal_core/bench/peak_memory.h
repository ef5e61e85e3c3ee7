#pragma once

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

}  // namespace thermal
