#pragma once

#include "io/system/files.h"

namespace thermal {

/// A new temporary folder; removed with its contents by the destructor. If this process is interrupted or killed, a
/// guard process removes it; if that fails, the next run that creates one does.
class TemporaryFolder {
 public:
  /// IoError if it cannot be created.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const Path& path() const noexcept { return path_; }

 private:
  void start_guard();

  Path path_;
  int lock_ = -1;   ///< lock, held by this process while the folder is in use
  int guard_ = -1;  ///< process
  int life_ = -1;   ///< end of a pipe on which the guard waits; the system closes it with this process
};

}  // namespace thermal
