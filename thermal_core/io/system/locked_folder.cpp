#include "io/system/locked_folder.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace thermal {
namespace {

/// Negative if the folder does not exist.
int open_folder(const Path& folder) noexcept {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Creates and opens a folder. Another file of that name is removed.
int make_and_open(const Path& folder) {
  make_folder(folder.parent_path().empty() ? Path(".") : folder.parent_path());
  for (int tries = 0; tries < 2; ++tries) {
    if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) fail_at("make folder", folder, errno);
    if (const int descriptor = open_folder(folder); descriptor >= 0) return descriptor;
    if (errno == ELOOP || errno == ENOTDIR) ::unlink(folder.c_str());
  }
  fail_at("open", folder, errno);
}

/// Whether another run holds it; if `wait`, waits for it first. Other errors mean that the file system cannot lock
/// folders.
bool is_held(int descriptor, bool wait) noexcept {
  while (::flock(descriptor, wait ? LOCK_EX : LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    return errno == EWOULDBLOCK;
  }
  return false;
}

/// False if the run that held the open folder has moved or removed it.
bool is_at(int descriptor, const Path& folder) noexcept {
  struct stat open = {};
  struct stat there = {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(folder.c_str(), &there) == 0 &&
         open.st_dev == there.st_dev && open.st_ino == there.st_ino;
}

void empty(const Path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::filesystem::remove_all(entry->path(), error);
    if (error) break;
  }
  if (error) fail_at("empty", folder, error.value());
}

}  // namespace

LockedFolder::LockedFolder(const Path& folder) : folder_(folder) {
  check_is_no_link(folder.parent_path());
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = make_and_open(folder);
    (void)is_held(descriptor_, true);
  } while (!is_at(descriptor_, folder));
  try {
    empty(folder);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

LockedFolder::~LockedFolder() {
  if (is_at(descriptor_, folder_)) (void)sweep_folder(folder_);
  ::close(descriptor_);
}

std::optional<LeftOver> sweep_unless_locked(const Path& folder) {
  const int descriptor = open_folder(folder);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR || errno == ELOOP)) return std::nullopt;
  if (descriptor < 0) return LeftOver{.location = folder, .reason = std::strerror(errno)};
  std::optional<LeftOver> left_over;
  if (!is_held(descriptor, false) && is_at(descriptor, folder)) left_over = sweep_folder(folder);
  ::close(descriptor);
  return left_over;
}

}  // namespace thermal
