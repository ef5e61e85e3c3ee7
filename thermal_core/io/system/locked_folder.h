#pragma once

#include <optional>

#include "io/system/files.h"

namespace thermal {

/// An empty, locked folder in which a result is built before it is renamed. The system releases the lock when the
/// process ends. Where the file system cannot lock folders, it is not locked.
class LockedFolder {
 public:
  /// Waits until no other run holds it. Creates it, or removes files of a killed run. IoError if that fails.
  explicit LockedFolder(const Path& folder);
  /// Removes the folder, unless it was moved.
  ~LockedFolder();
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

 private:
  Path folder_;
  int descriptor_ = -1;
};

/// Removes such a folder of a killed run, unless a run holds it. Returns what could not be removed.
std::optional<LeftOver> sweep_unless_locked(const Path& folder);

}  // namespace thermal
