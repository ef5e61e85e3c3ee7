#include "io/passing_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::string_view kPrefix = ".veldt-passing-";  // nobody else's: what has this name is removed

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
}

PassingFolder::~PassingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ::close(lock_);
}

}  // namespace thermal
