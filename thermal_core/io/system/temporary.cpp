#include "io/system/temporary.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::string_view kPrefix = ".veldt-passing-";  // ours alone: folders with it are removed

/// Locks a folder; returns its descriptor, or -1 if another process has locked it, or it is gone.
int lock_folder(const Path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Removes leftovers of killed runs; other users' folders cannot be removed.
void sweep(const Path& temporary) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(temporary, ignored)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    const int lock = lock_folder(entry.path());
    if (lock < 0) continue;
    std::filesystem::remove_all(entry.path(), ignored);
    ::close(lock);
  }
}

/// Waits until the process at the other end of the pipe ends, then becomes "rm -rf FOLDER". Between fork and exec:
/// nothing but system calls that are safe there.
[[noreturn]] void guard(int pipe, char* const* removal) {
  ::setpgid(0, 0);  // so that Ctrl-C does not reach it
  ::dup2(pipe, STDIN_FILENO);
  ::close_range(STDIN_FILENO + 1, ~0U, 0);
  char byte = 0;
  while (::read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
  }
  char* const none[] = {nullptr};  // NOLINT(modernize-avoid-c-arrays): as execve wants it
  ::execve(removal[0], removal, none);
  ::_exit(1);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  const Path temporary = std::filesystem::temp_directory_path();
  sweep(temporary);
  while (lock_ < 0) {  // again if another run removed the folder before it was locked
    std::string name = (temporary / kPrefix).string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw IoError("cannot make a folder " + name + ": " + std::strerror(errno));
    path_ = name;
    lock_ = lock_folder(path_);
  }
  start_guard();
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ::close(lock_);
  if (guard_ > 0) {
    ::kill(guard_, SIGKILL);
    while (::waitpid(guard_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(life_);
}

/// If the system refuses to start a guard, the next run removes the folder.
void TemporaryFolder::start_guard() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  std::array<std::string, 4> words = {"/bin/rm", "-rf", "--", path_.string()};
  const std::array<char*, 5> removal = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                                        nullptr};
  guard_ = ::fork();
  if (guard_ == 0) guard(ends[0], removal.data());
  ::close(ends[0]);
  life_ = ends[1];
}

TemporaryFile::TemporaryFile(const Path& place) : place_(place), path_(place) {
  path_ += ".tmp";
  ::unlink(path_.c_str());
}

TemporaryFile::~TemporaryFile() {
  if (!kept_) ::unlink(path_.c_str());
}

void TemporaryFile::keep() {
  const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) fail_at("write", path_, errno);
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0) fail_at("write", path_, error);
  if (::rename(path_.c_str(), place_.c_str()) != 0) fail_at("rename to", place_, errno);
  kept_ = true;
  sync_folder(place_.parent_path());
}

namespace {

void read_lines(std::istream& in, const Spool::TakeLine& take) {
  for (std::string line; std::getline(in, line);) take(line);
}

}  // namespace

Spool::Spool(Path file) : file_(std::move(file)) {
  if (!file_.empty()) out_.emplace(file_);
}

Spool::~Spool() {
  std::error_code error;  // if this fails, the file stays
  if (!file_.empty()) std::filesystem::remove(file_, error);
}

void Spool::add(std::string_view line) {
  if (!out_) {
    text_.append(line).push_back('\n');
    return;
  }
  out_->add(line);
  out_->add("\n");
}

void Spool::read(const TakeLine& take) {
  if (!out_) {
    std::istringstream in(text_);
    return read_lines(in, take);
  }
  (void)out_->close();
  std::ifstream in(file_);
  read_lines(in, take);
  if (in.bad() || !in.eof()) throw IoError(fmt::format("cannot read {}: it has disappeared", file_.string()));
  std::error_code error;
  std::filesystem::remove(file_, error);
  if (error) fail_at("remove", file_, error.value());
  file_.clear();
}

}  // namespace thermal
