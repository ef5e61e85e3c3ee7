#pragma once

#include "io/system/files.h"

namespace thermal {

/// A file that some library writes under a temporary name, so that whoever looks finds the file whole or as it was.
class TemporaryFile {
 public:
  /// What becomes `place`. Removes what an earlier run has left under the temporary name, a link alone.
  explicit TemporaryFile(const Path& place);
  /// Removes the file unless it was kept.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// "FILE.tmp", beside `place`.
  [[nodiscard]] const Path& path() const noexcept { return path_; }

  /// Flushes the file, which must be closed, to disk and renames it. IoError or TryAgainError naming the file.
  void keep();

 private:
  Path place_;
  Path path_;
  bool kept_ = false;
};

}  // namespace thermal
