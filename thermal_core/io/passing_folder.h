#pragma once

#include "io/files.h"

namespace thermal {

/// A new folder among the system's temporary files; gone, with all it holds, when this ends.
class PassingFolder {
 public:
  /// IoError if none can be made.
  PassingFolder();
  ~PassingFolder();
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const Path& path() const noexcept { return path_; }

 private:
  Path path_;
};

}  // namespace thermal
