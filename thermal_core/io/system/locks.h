#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// A lock on a folder, or on parts of it, held for the object's lifetime; the system releases it when the process
/// ends. A folder belongs to one run, or is shared by several runs that each lock their own parts.
class FolderLock {
 public:
  /// Locks all of it. Creates `folder` if needed. TryAgainError if another run holds any of it.
  explicit FolderLock(const Path& folder);
  /// Locks some of its parts, possibly none. TryAgainError if another run holds all of it or one of them.
  FolderLock(const Path& folder, const std::vector<std::size_t>& places);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Waits for exclusive access to the files that all runs sharing the folder write, then calls the function. Not
  /// thread-safe.
  void in_turn(const std::function<void()>& change) const;

 private:
  int descriptor_ = -1;
};

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
