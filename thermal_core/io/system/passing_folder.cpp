#include "io/system/passing_folder.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::string_view kPrefix = ".veldt-passing-";  // no other program's: what has this name is removed

/// The descriptor of a folder that no other process has locked; -1 if one has, or if it is gone.
int lock_folder(const Path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Removes what killed runs have left. Of other users' folders nothing can be removed.
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

/// Waits for the end of the process that holds the other end of the pipe, then becomes "rm -rf FOLDER". Between fork and
/// exec: nothing but system calls that are safe there.
[[noreturn]] void guard(int pipe, char* const* removal) {
  ::setpgid(0, 0);  // Ctrl-C is not for it
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

PassingFolder::PassingFolder() {
  const Path temporary = std::filesystem::temp_directory_path();
  sweep(temporary);
  while (lock_ < 0) {  // again if another run sweeps the folder before it is locked
    std::string name = (temporary / kPrefix).string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw IoError("cannot make a folder " + name + ": " + std::strerror(errno));
    path_ = name;
    lock_ = lock_folder(path_);
  }
  start_guard();
}

PassingFolder::~PassingFolder() {
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

/// Without a guard, where the system refuses one, the next run removes the folder.
void PassingFolder::start_guard() {
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

}  // namespace thermal
