#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace thermal {

using Path = std::filesystem::path;

/// Whole content. IoError naming the file and the system's reason.
[[nodiscard]] std::string read_file(const Path& file);

/// Writes under a temporary name beside `file`, syncs, renames: the file is whole or as it was before.
/// IoError naming the file and the system's reason; TryAgainError when the disk is full.
void write_file_atomically(const Path& file, std::string_view content);

/// The same without the temporary name, for files inside a folder that is itself renamed when whole.
void write_file(const Path& file, std::span<const std::byte> content);

/// mkdir -p. IoError naming the folder and the system's reason.
void make_folder(const Path& folder);

/// So little room is left where this folder is (under 64 KiB) that a write there that failed, failed for that.
[[nodiscard]] bool is_disk_full(const Path& folder);

/// Flushes a folder's entries to disk, so that a rename in it survives a power cut.
void sync_folder(const Path& folder);

/// Holds a lock on a folder for as long as it lives; the system lets go of it when the process dies.
class FolderLock {
 public:
  /// Creates `folder` if need be. TryAgainError if another process holds it.
  explicit FolderLock(const Path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace thermal
