#include "io/files.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Throws what an errno says about a file.
[[noreturn]] void fail(std::string_view doing, const Path& file, int error) {
  const std::string message = fmt::format("cannot {} {}: {}", doing, file.string(), std::strerror(error));
  if (error == ENOSPC || error == EDQUOT) throw TryAgainError(message);
  throw IoError(message);
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const Path& file, int flags, std::string_view doing)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {  // 0666: the user's umask decides
    if (number_ < 0) fail(doing, file, errno);
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] int release() noexcept { return std::exchange(number_, -1); }

 private:
  int number_;
};

void write_all(const Path& file, const std::byte* data, std::size_t bytes, bool sync) {
  const Descriptor out(file, O_WRONLY | O_CREAT | O_TRUNC, "write");
  while (bytes > 0) {
    const ssize_t written = ::write(out.number(), data, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write", file, errno);
    data += written;
    bytes -= static_cast<std::size_t>(written);
  }
  if (sync && ::fsync(out.number()) != 0) fail("write", file, errno);
}

}  // namespace

std::string read_file(const Path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("read", file, errno == 0 ? EIO : errno);
  if (std::filesystem::is_directory(file)) fail("read", file, EISDIR);
  std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) fail("read", file, EIO);
  return content;
}

void write_file_atomically(const Path& file, std::string_view content) {
  Path temporary = file;
  temporary += ".tmp";  // always the same, so that what a killed run left is written over
  write_all(temporary, reinterpret_cast<const std::byte*>(content.data()), content.size(), true);
  if (::rename(temporary.c_str(), file.c_str()) != 0) fail("rename to", file, errno);
  sync_folder(file.parent_path());
}

void write_file(const Path& file, std::span<const std::byte> content) {
  write_all(file, content.data(), content.size(), false);
}

void make_folder(const Path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("make folder", folder, error.value());
}

bool is_disk_full(const Path& folder) {
  constexpr std::uintmax_t kNoRoom = 64 * 1024;
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return !error && space.available < kNoRoom;
}

void sync_folder(const Path& folder) {
  const Path named = folder.empty() ? Path(".") : folder;
  const Descriptor descriptor(named, O_RDONLY | O_DIRECTORY, "open");
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL) fail("sync", named, errno);
}

FolderLock::FolderLock(const Path& folder) {
  make_folder(folder);
  Descriptor lock(folder / ".lock", O_RDWR | O_CREAT, "lock");
  if (::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) {
    throw TryAgainError(fmt::format("{} is in use by another run of veldt; try again when that one has ended",
                                    folder.string()));
  }
  descriptor_ = lock.release();
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace thermal
