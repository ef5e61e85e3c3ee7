#pragma once

#include <cstddef>
#include <functional>
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

}  // namespace thermal
