#pragma once

#include <optional>

#include "io/system/files.h"

namespace thermal {

/// An empty folder in which something is made before it is moved to its place. One run holds it; the system releases
/// it when the process ends. Where the file system cannot lock folders, it is not held.
class HeldFolder {
 public:
  /// Waits until no other run holds it. Creates it, or empties it: a run that was killed may have left files. IoError
  /// if that fails.
  explicit HeldFolder(const Path& folder);
  /// Removes it, if it is still there and not moved.
  ~HeldFolder();
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;

 private:
  Path folder_;
  int descriptor_ = -1;
};

/// Removes what a killed run has left of such a folder, unless a run holds it. Returns what could not be removed.
std::optional<LeftOver> sweep_unless_held(const Path& folder);

}  // namespace thermal
