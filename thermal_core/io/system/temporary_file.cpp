#include "io/system/temporary_file.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

namespace thermal {

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

}  // namespace thermal
