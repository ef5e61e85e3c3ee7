#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thermal {

using Path = std::filesystem::path;

/// A fault of the system's, by its number: "cannot DOING PLACE: reason". TryAgainError when the disk is full, else IoError.
[[noreturn]] void fail_at(std::string_view doing, const Path& place, int error);

/// Content in pieces of some ten kilobytes, in order. IoError naming the file and the system's reason.
void read_pieces(const Path& file, const std::function<void(std::string_view piece)>& take);

/// Whole content. IoError as read_pieces().
[[nodiscard]] std::string read_file(const Path& file);

/// Refuses what is there under a name but is no file: a folder, or a pipe or device that would be waited for, or read,
/// without end. "cannot read FILE: " and why in an IoError, also if there is nothing.
void check_is_file(const Path& file);

/// Refuses a symbolic link where something is to be written: it would land elsewhere. IoError naming link and target.
void check_is_no_link(const Path& place);

/// Writes under a temporary name beside `file`, syncs, renames: the file is whole or as it was before, and so is
/// whatever a link of either name leads to.
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

/// Bytes that this user may still write where this folder is. IoError naming it and the system's reason.
[[nodiscard]] std::int64_t room_left_bytes(const Path& folder);

/// A folder's lock, or a part of it, for as long as it lives; the system lets go of it when the process dies. The
/// folder is one run's alone, or several runs share it, each with places of its own.
class FolderLock {
 public:
  /// All of it. Creates `folder` if need be. TryAgainError if another run holds any of it.
  explicit FolderLock(const Path& folder);
  /// These places of it, which may be none. TryAgainError if another run holds all of it or one of them.
  FolderLock(const Path& folder, const std::vector<std::size_t>& places);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Waits until it is this run's turn to change what all that share the folder write, and then does it. Not for
  /// two threads at once.
  void in_turn(const std::function<void()>& change) const;

 private:
  int descriptor_ = -1;
};

}  // namespace thermal
