#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

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

/// Lines written one after another and read back once; kept in a file, so that memory does not grow with them.
class Spool {
 public:
  using TakeLine = std::function<void(std::string_view line)>;

  /// Writes to `file`, which is removed with this object. Empty: in memory, for few lines.
  explicit Spool(Path file = {});
  ~Spool();
  Spool(Spool&&) noexcept = default;
  Spool& operator=(Spool&&) noexcept = delete;

  /// Errors as OutputFile.
  void add(std::string_view line);

  /// Returns every line in order, without its end; then the file is removed. Call once. IoError if the file cannot be
  /// read.
  void read(const TakeLine& take);

 private:
  Path file_;
  std::optional<OutputFile> out_;
  std::string text_;  ///< in memory
};

}  // namespace thermal
