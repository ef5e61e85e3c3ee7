#include "io/passing_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/error.h"

namespace thermal {

PassingFolder::PassingFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "veldt-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw IoError("cannot make a folder " + name + ": " + std::strerror(errno));
  path_ = name;
}

PassingFolder::~PassingFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace thermal
