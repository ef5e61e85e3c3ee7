#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/system/files.h"

namespace thermal {

/// A tar archive (ustar) written file by file; only the current one is in memory. Its bytes depend on names and contents
/// alone: every file is of time 0, user and group 0, and mode 0644. A name that ustar cannot hold gets a pax header.
/// All functions may throw an IoError with the archive and the system's reason, or a TryAgainError if the disk is full.
class TarFile {
 public:
  /// A new file, written from start to end, as object stores require. IoError also if there is a file or a link of this
  /// name.
  explicit TarFile(const Path& file);
  /// Removes the archive if it was not closed.
  ~TarFile();
  TarFile(const TarFile&) = delete;
  TarFile& operator=(const TarFile&) = delete;

  /// Appends a file. `name` is a relative path, "/" between folders.
  void add(const std::string& name, std::string_view content);

  /// Ends the archive, which is incomplete before.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermal
