#pragma once

#include "io/system/files.h"

namespace thermal {

/// A new temporary folder; removed with its contents at the end of the object's life. If this process is interrupted or
/// killed, a guard process removes it; what that could not remove, the next run that makes one does.
class PassingFolder {
 public:
  /// IoError if it cannot be created.
  PassingFolder();
  ~PassingFolder();
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const Path& path() const noexcept { return path_; }

 private:
  void start_guard();

  Path path_;
  int lock_ = -1;   ///< held as long as the folder is in use, by this process alone
  int guard_ = -1;  ///< process
  int life_ = -1;   ///< of a pipe whose end the guard waits for; the system closes it with this process
};

}  // namespace thermal
