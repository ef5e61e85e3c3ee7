#include "io/output_folder.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fcntl.h>

namespace thermal {
namespace {

std::error_code rename_with(const Path& from, const Path& to, unsigned flags) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0) return {};
  return {errno, std::generic_category()};
}

/// Not every file system can exchange; then there is a moment with neither.
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

void replace_folder(const Path& whole, const Path& place) {
  std::error_code error = rename_with(whole, place, RENAME_EXCHANGE);
  if (!error) sweep_folder(whole);
  if (error.value() == ENOENT) error = rename_with(whole, place, 0);
  if (error.value() == EINVAL || error.value() == ENOSYS) error = rename_after_removal(whole, place);
  if (error) fail_at("rename to", place, error.value());
  sync_folder(place.parent_path());
}

void sweep_folder(const Path& folder) noexcept {
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace thermal
