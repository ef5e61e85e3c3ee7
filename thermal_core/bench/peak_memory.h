#pragma once

namespace thermal {

/// How much more memory this process has had, at its peak, than when this object was created. Before that, what nothing
/// uses is returned to the system. Of two such objects, only the younger one measures.
class PeakMemory {
 public:
  PeakMemory();

  /// [MB]; NaN where the system cannot start anew with its peak (/proc/self/clear_refs).
  [[nodiscard]] double grown_mb() const;

 private:
  double before_mb_ = 0;
};

}  // namespace thermal
