#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "io/system/sha256.h"

namespace thermal {

/// Path of a file or folder.
using Path = std::filesystem::path;

/// An error of the system by its number: "cannot DOING PLACE: reason". TryAgainError if the disk is full, otherwise
/// IoError.
[[noreturn]] void fail_at(std::string_view doing, const Path& location, int error);

/// Content of a file or a pipe in pieces of at most 64 KiB, in order. A pipe without a writer is empty. IoError with the
/// file and the system's reason, or if it is a folder or a device.
void read_pieces(const Path& file, const std::function<void(std::string_view piece)>& take);

/// Whole content, at most 1 GiB. IoError as read_pieces(), or if it is larger.
[[nodiscard]] std::string read_file(const Path& file);

/// Whether a file exists and has this content. IoError as read_file().
[[nodiscard]] bool has_content(const Path& file, std::string_view content);

/// SHA-256 of a file's content, of any size, in constant memory. IoError as read_pieces().
[[nodiscard]] std::string sha256_of_file(const Path& file);

/// Refuses anything that is not a regular file: a folder, or a pipe or device, on which reading might block or never
/// end. IoError "cannot read FILE: " with the reason, also if it does not exist.
void check_is_file(const Path& file);

/// Refuses a symbolic link: reading or writing would follow it elsewhere. IoError with link and target.
void check_is_no_link(const Path& location);

/// For a file that belongs to a dataset: neither it nor its folder is a link, and it is a regular file. IoError as both
/// checks above.
void check_is_own_file(const Path& file);

/// check_is_no_link() for a folder with all that is in it and in the folders in it. What does not exist is no link.
void check_has_no_links(const Path& folder);

/// Writes under a temporary name beside `file`, syncs, renames: the file is complete or unchanged. Links of either name
/// are replaced, not followed. Where files cannot be renamed, as on object stores, it is written directly: such a file
/// appears when it is closed.
/// IoError with the file and the system's reason; TryAgainError if the disk is full.
void write_file_atomically(const Path& file, std::string_view content);

/// A new file, without a temporary name, inside a folder that is itself renamed when complete. IoError as above, also
/// for an existing file or link of this name.
void write_file(const Path& file, std::span<const std::byte> content);

/// A new file with the content of another, of any size, in constant memory. Errors as read_pieces() and write_file().
void copy_content(const Path& from, const Path& to);

/// mkdir -p. IoError with the folder and the system's reason.
void make_folder(const Path& folder);

/// Whether so little disk space is left at this folder (under 64 KiB) that it explains a failed write.
[[nodiscard]] bool is_disk_full(const Path& folder);

/// Flushes a folder's entries to disk, so that a rename in it survives a power failure.
void sync_folder(const Path& folder);

/// Bytes that this user may still write at this folder. IoError with the folder and the system's reason.
[[nodiscard]] std::int64_t free_bytes(const Path& folder);

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

  /// close(), with the file flushed to disk and moved to `place`, which is complete or unchanged, as in
  /// write_file_atomically(); `place` may be on another file system.
  std::string close_as(const Path& location);

 private:
  struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  using Stream = std::unique_ptr<std::FILE, Close>;

  Path file_;
  Stream stream_;
  Sha256 sum_;
};

/// Creates an empty folder of this name, and its parents. Existing contents are removed; of a link, only the link
/// itself. IoError if its parent is a link to elsewhere, or with the system's reason; TryAgainError if the disk is
/// full.
void make_fresh_folder(const Path& folder);

/// Creates a folder, unless it exists, in which other programs will write files by their names. IoError if it, or
/// anything in it at any depth, is a link to elsewhere, or with the system's reason; TryAgainError if the disk is full.
void make_own_folder(const Path& folder);

/// Renames a complete folder to `place`, replacing an existing one in one step: readers see either the old or the new
/// folder, also after a crash. Parts of the old one that cannot be removed stay at `whole`. IoError or TryAgainError
/// with `place`.
void replace_folder(const Path& whole, const Path& location);

/// Copies the files of a complete folder to `place` one by one, `last` last, then removes the folder, as far as
/// possible. Existing contents of `place` are removed first. For file systems that cannot rename folders: readers treat
/// the folder as complete once it has `last`, which appears with its whole content.
/// IoError with the file and the system's reason; TryAgainError if the disk is full.
void put_folder(const Path& whole, const Path& location, const Path& last);

/// A temporary file or folder of ours that could not be removed.
struct LeftOver {
  Path location;
  std::string reason;  ///< of the system
};

/// Removes a folder with its contents, or a file; of links, only the links. Returns what could not be removed.
std::optional<LeftOver> sweep_folder(const Path& location);

/// How to create a second name of a file.
enum class Linking { hard, symlink, copy };

/// Makes `as` the same file as `file`, creating missing folders: a hard link, a symbolic link to its absolute path, or
/// a copy. If `file` is a symbolic link, its target is linked. Falls back to a copy where the file system cannot link:
/// across file systems, beyond its limit of links. Returns the method used. Never replaces or writes through an
/// existing `as`. IoError with the file and the system's reason; TryAgainError if the disk is full.
Linking link_file(const Path& file, const Path& as, Linking wanted);

/// The result of `work`; messages of DataErrors are prefixed with the file's name.
template <typename Work>
auto naming(const Path& file, const Work& work) {
  try {
    return work();
  } catch (const DataError& error) {
    throw DataError(file.string() + ": " + error.what());
  }
}

}  // namespace thermal
