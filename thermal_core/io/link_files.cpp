#include "io/link_files.h"

#include <system_error>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
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
