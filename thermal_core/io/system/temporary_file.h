#pragma once

#include "io/system/files.h"

namespace thermal {

/// A file that a library writes under a temporary name, so that readers find the file either complete or unchanged.
class TemporaryFile {
 public:
  /// `place`: the final name. Removes a leftover under the temporary name, of a link the link alone.
  explicit TemporaryFile(const Path& place);
  /// Removes the file unless keep() was called.
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
