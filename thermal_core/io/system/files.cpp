#include "io/system/files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace thermal {
namespace {

constexpr std::size_t kMostReadBytes = std::size_t{1} << 30U;

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const Path& file, int flags, std::string_view doing)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {  // 0666: the user's umask decides
    if (number_ < 0) fail_at(doing, file, errno);
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] int release() noexcept { return std::exchange(number_, -1); }
  /// Reports write errors that the system has deferred.
  void close(const Path& file) {
    if (::close(release()) != 0 && errno != EINTR) fail_at("write", file, errno);
  }

 private:
  int number_;
};

struct Writing {
  bool sync = false;  ///< it must survive a power failure
};

void write_bytes(const Descriptor& out, const Path& file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(out.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_at("write", file, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

/// Creates a file; an existing file or link is an error, and not written to.
void write_new(const Path& file, std::span<const std::byte> bytes, const Writing& how) {
  Descriptor out(file, O_WRONLY | O_CREAT | O_EXCL, "write");
  write_bytes(out, file, bytes);
  if (how.sync && ::fsync(out.number()) != 0) fail_at("write", file, errno);
  out.close(file);
}

/// Refuses folders and devices, of which some never end. Reading a pipe may wait for its writer.
void check_can_end(const Descriptor& in, const Path& file) {
  struct stat status = {};
  if (::fstat(in.number(), &status) != 0) fail_at("read", file, errno);
  if (S_ISDIR(status.st_mode)) fail_at("read", file, EISDIR);
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
    throw IoError(fmt::format("cannot read {}: it is a device; expected a file or a pipe", file.string()));
  if (::fcntl(in.number(), F_SETFL, 0) != 0) fail_at("read", file, errno);  // wait for data
}

}  // namespace

void fail_at(std::string_view doing, const Path& location, int error) {
  const std::string message = fmt::format("cannot {} {}: {}", doing, location.string(), std::strerror(error));
  if (error == ENOSPC || error == EDQUOT) throw TryAgainError(message);
  throw IoError(message);
}

void read_pieces(const Path& file, const std::function<void(std::string_view piece)>& take) {
  // O_NONBLOCK: opening a pipe without a writer would wait for one.
  const Descriptor in(file, O_RDONLY | O_NONBLOCK | O_NOCTTY, "read");
  check_can_end(in, file);
  std::vector<char> piece(1 << 16);
  for (;;) {
    const ssize_t bytes = ::read(in.number(), piece.data(), piece.size());
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) fail_at("read", file, errno);
    if (bytes == 0) return;
    take({piece.data(), static_cast<std::size_t>(bytes)});
  }
}

std::string read_file(const Path& file) {
  std::string content;
  read_pieces(file, [&](std::string_view piece) {
    if (content.size() + piece.size() > kMostReadBytes)
      throw IoError(fmt::format("cannot read {}: more than {} bytes; expected at most 1 GiB", file.string(),
                                kMostReadBytes));
    content.append(piece);
  });
  return content;
}

bool has_content(const Path& file, std::string_view content) {
  return std::filesystem::exists(file) && read_file(file) == content;
}

std::string sha256_of_file(const Path& file) {
  Sha256 sum;
  read_pieces(file, [&sum](std::string_view piece) { sum.add(piece); });
  return sum.hex();
}

void check_is_file(const Path& file) {
  using Type = std::filesystem::file_type;
  std::error_code error;
  const Type type = std::filesystem::status(file, error).type();
  if (type == Type::regular) return;
  if (type == Type::not_found) throw IoError(fmt::format("cannot read {}: no such file", file.string()));
  if (error) fail_at("read", file, error.value());
  throw IoError(fmt::format("cannot read {}: it is {}; expected a file", file.string(),
                            type == Type::directory ? "a folder" : "a pipe or a device"));
}

void check_is_no_link(const Path& location) {
  std::error_code error;
  const Path target = std::filesystem::read_symlink(location, error);
  if (error) return;
  throw IoError(fault(location.string(), fmt::format("a link to {}", target.string()), "",
                      "a path that is not a link; nothing elsewhere is read or written"));
}

void check_is_own_file(const Path& file) {
  check_is_no_link(file.parent_path());
  check_is_no_link(file);
  check_is_file(file);
}

void check_has_no_links(const Path& folder) {
  check_is_no_link(folder);
  if (!std::filesystem::is_directory(folder)) return;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (const std::filesystem::recursive_directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_symlink()) check_is_no_link(entry->path());
  }
  if (error) fail_at("read", folder, error.value());
}

namespace {

/// Renames a file. False, with nothing changed, where that is impossible: on an object store, or across file systems.
bool can_rename(const Path& from, const Path& location) {
  if (::rename(from.c_str(), location.c_str()) == 0) return true;
  if (errno != ENOSYS && errno != EOPNOTSUPP && errno != EXDEV) fail_at("rename to", location, errno);
  return false;
}

/// Writes by `write` under a temporary name, then renames; where that is impossible, writes to the final name.
void write_in_place(const Path& file, const std::function<void(const Path& as)>& write) {
  Path temporary = file;
  temporary += ".tmp";  // always the same, so that leftovers of a killed run are overwritten
  ::unlink(temporary.c_str());
  try {
    write(temporary);
    if (!can_rename(temporary, file)) {
      ::unlink(temporary.c_str());
      ::unlink(file.c_str());
      temporary = file;
      write(file);
    }
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_folder(file.parent_path());
}

}  // namespace

void write_file_atomically(const Path& file, std::string_view content) {
  write_in_place(
      file, [content](const Path& as) { write_new(as, std::as_bytes(std::span(content)), {.sync = true}); });
}

void write_file(const Path& file, std::span<const std::byte> content) {
  write_new(file, content, {.sync = false});
}

void copy_content(const Path& from, const Path& to) {
  Descriptor out(to, O_WRONLY | O_CREAT | O_EXCL, "write");
  read_pieces(from, [&](std::string_view piece) { write_bytes(out, to, std::as_bytes(std::span(piece))); });
  out.close(to);
}

void make_folder(const Path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_at("make folder", folder, error.value());
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
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL) fail_at("sync", named, errno);
}

std::int64_t free_bytes(const Path& folder) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error) fail_at("get the free disk space of", folder, error.value());
  constexpr auto kMost = static_cast<std::uintmax_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(space.available, kMost));
}

OutputFile::OutputFile(const Path& file) : file_(file) {
  ::unlink(file.c_str());
  stream_.reset(
      std::fopen(file.c_str(), "wxe"));  // x: fails if something has been created meanwhile; e: close on exec
  if (!stream_) fail_at("write", file_, errno);
}

OutputFile::~OutputFile() {
  if (stream_) ::unlink(file_.c_str());
}

void OutputFile::add(std::string_view text) {
  if (text.empty()) return;  // the pointer of an empty view may be null, which fwrite() does not allow
  sum_.add(text);
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) != text.size()) fail_at("write", file_, errno);
}

std::string OutputFile::close() {
  if (std::fclose(stream_.release()) != 0) {
    const int error = errno;
    ::unlink(file_.c_str());
    fail_at("write", file_, error);
  }
  return sum_.hex();
}

namespace {

struct RemoveAtEnd {
  const Path& file;
  ~RemoveAtEnd() { ::unlink(file.c_str()); }
};

}  // namespace

std::string OutputFile::close_as(const Path& location) {
  if (std::fflush(stream_.get()) != 0 || ::fsync(::fileno(stream_.get())) != 0)
    fail_at("write", file_, errno);
  std::string sum = close();
  if (!can_rename(file_, location)) {
    const RemoveAtEnd remove{file_};
    write_in_place(location, [this](const Path& as) { copy_content(file_, as); });
  }
  sync_folder(location.parent_path());
  return sum;
}

namespace {

std::error_code rename_with(const Path& from, const Path& to, unsigned flags) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0) return {};
  return {errno, std::generic_category()};
}

/// For file systems that cannot exchange names: for a moment there is neither folder.
std::error_code rename_after_removal(const Path& from, const Path& to) {
  std::error_code error;
  std::filesystem::remove_all(to, error);
  return error ? error : rename_with(from, to, 0);
}

}  // namespace

void make_fresh_folder(const Path& folder) {
  check_is_no_link(folder.parent_path());
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (error) fail_at("empty", folder, error.value());
  make_folder(folder);
}

void make_own_folder(const Path& folder) {
  check_has_no_links(folder);
  make_folder(folder);
}

void replace_folder(const Path& whole, const Path& location) {
  std::error_code error = rename_with(whole, location, RENAME_EXCHANGE);
  if (!error) (void)sweep_folder(whole);
  if (error.value() == ENOENT) error = rename_with(whole, location, 0);
  if (error.value() == EINVAL || error.value() == ENOSYS) error = rename_after_removal(whole, location);
  if (error) fail_at("rename to", location, error.value());
  sync_folder(location.parent_path());
}

void put_folder(const Path& whole, const Path& location, const Path& last) {
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(whole))
    if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(whole));
  std::ranges::sort(files);
  std::erase(files, last);
  make_fresh_folder(location);
  try {
    for (const Path& file : files) {
      make_folder((location / file).parent_path());
      copy_content(whole / file, location / file);
    }
    write_file_atomically(location / last, read_file(whole / last));
  } catch (...) {
    (void)sweep_folder(location);
    throw;
  }
  (void)sweep_folder(whole);
}

std::optional<LeftOver> sweep_folder(const Path& location) {
  std::error_code error;
  std::filesystem::remove_all(location, error);
  if (!error) return std::nullopt;
  return LeftOver{.location = location, .reason = error.message()};
}

namespace {

/// Resolves symbolic links first: a hard link to a symbolic link would link to the link itself.
Path real_path(const Path& file) {
  std::error_code error;
  Path real = std::filesystem::canonical(file, error);
  if (error) throw IoError(fmt::format("cannot read {}: {}", file.string(), error.message()));
  return real;
}

}  // namespace

Linking link_file(const Path& file, const Path& as, Linking wanted) {
  const Path real = real_path(file);
  make_folder(as.parent_path());
  std::error_code error;
  if (wanted == Linking::hard) std::filesystem::create_hard_link(real, as, error);
  if (wanted == Linking::symlink) std::filesystem::create_symlink(real, as, error);
  if (wanted != Linking::copy && !error) return wanted;
  if (error == std::errc::file_exists) fail_at("write", as, error.value());
  copy_content(real, as);
  return Linking::copy;
}

}  // namespace thermal
