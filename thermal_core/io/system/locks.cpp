#include "io/system/locks.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Meaning of the bytes of a lock file; they are locked, not written. These are locks of open files (OFD), because
/// locks of processes are lost when any other descriptor of the file is closed.
constexpr off_t kTurnByte = 0;    // held exclusively to change files that all runs write
constexpr off_t kSharedByte = 1;  // held by runs that share the folder, so that no run can lock it completely
constexpr off_t kFirstPlace = 2;
constexpr off_t kToTheEnd = 0;  // as a length

struct flock bytes_of_lock(short kind, off_t first, off_t count) {
  struct flock bytes = {};
  bytes.l_type = kind;
  bytes.l_whence = SEEK_SET;
  bytes.l_start = first;
  bytes.l_len = count;
  return bytes;
}

/// The lock file of a folder, open.
class LockFile {
 public:
  explicit LockFile(const Path& folder) {
    make_folder(folder);
    const Path file = folder / ".lock";
    check_is_no_link(file);
    number_ =
        ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);  // 0666: as the umask decides
    if (number_ < 0) fail_at("lock", file, errno);
  }
  ~LockFile() {
    if (number_ >= 0) ::close(number_);
  }
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;
  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] int release() noexcept { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

void take(const LockFile& lock, short kind, off_t first, off_t count, const Path& folder) {
  struct flock wanted = bytes_of_lock(kind, first, count);
  if (::fcntl(lock.number(), F_OFD_SETLK, &wanted) == 0) return;
  if (errno != EAGAIN && errno != EACCES) fail_at("lock", folder / ".lock", errno);
  throw TryAgainError(fmt::format("{} is in use by another run of veldt; try again when that one has ended",
                                  folder.string()));
}

}  // namespace

FolderLock::FolderLock(const Path& folder) {
  LockFile lock(folder);
  take(lock, F_WRLCK, 0, kToTheEnd, folder);
  descriptor_ = lock.release();
}

FolderLock::FolderLock(const Path& folder, const std::vector<std::size_t>& places) {
  LockFile lock(folder);
  take(lock, F_RDLCK, kSharedByte, 1, folder);
  for (const std::size_t path : places)
    take(lock, F_WRLCK, kFirstPlace + static_cast<off_t>(path), 1, folder);
  descriptor_ = lock.release();
}

FolderLock::~FolderLock() { ::close(descriptor_); }

void FolderLock::in_turn(const std::function<void()>& change) const {
  struct flock turn = bytes_of_lock(F_WRLCK, kTurnByte, 1);
  while (::fcntl(descriptor_, F_OFD_SETLKW, &turn) != 0) {
    if (errno != EINTR) throw IoError(fmt::format("cannot wait for a lock: {}", std::strerror(errno)));
  }
  struct EndOfTurn {
    int descriptor;
    ~EndOfTurn() {
      struct flock end = bytes_of_lock(F_UNLCK, kTurnByte, 1);
      (void)::fcntl(descriptor, F_OFD_SETLK, &end);
    }
  };
  const EndOfTurn end{descriptor_};
  change();
}

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
