#pragma once

#include "io/files.h"

namespace thermal {

/// A new temporary folder; removed with its contents at the end of the object's life, or, if this process is killed, by
/// the next run that makes one.
class PassingFolder {
 public:
  /// IoError if it cannot be created.
  PassingFolder();
  ~PassingFolder();
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const Path& path() const noexcept { return path_; }

 private:
  Path path_;
  int lock_ = -1;  ///< held as long as the folder is in use, by this process alone
};

}  // namespace thermal
