#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "io/files.h"
#include "io/sha256.h"

namespace thermal {

/// A file written piece by piece together with its checksum; nothing of it stays in memory. All functions may throw
/// an IoError with the file and the system's reason, or a TryAgainError if the disk is full.
class OutputFile {
 public:
  /// Creates a file. An existing file of that name is removed; an existing link is replaced, not followed.
  explicit OutputFile(const Path& file);
  /// Removes the file if it was not closed.
  ~OutputFile();
  OutputFile(OutputFile&&) noexcept = default;
  OutputFile& operator=(OutputFile&&) noexcept = delete;

  void add(std::string_view text);

  /// Ends the file. Returns its SHA-256.
  std::string close();

  /// close(), with the file flushed to disk and renamed to `place`, which is complete or unchanged.
  std::string close_as(const Path& place);

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  using Stream = std::unique_ptr<std::FILE, Close>;

  Path file_;
  Stream stream_;
  Sha256 sum_;
};

}  // namespace thermal
