#include "dataset/exports/export_folder.h"

#include <system_error>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr const char* kExportLock = ".lock";

/// A killed run's folder has a lock in it; one without belongs to the user.
Path part_of(const Path& out, const Path& scratch) {
  Path part = scratch.empty() ? out : scratch / out.filename();
  part += ".part";
  if (std::filesystem::exists(part) && !std::filesystem::exists(part / kExportLock) &&
      !(std::filesystem::is_directory(part) && std::filesystem::is_empty(part)))
    throw ConfigError(fmt::format("{} is in the way; expected to make the result there before it becomes {}",
                                  part.string(), out.string()));
  return part;
}

}  // namespace

Path named_folder(const Path& folder) {
  const Path path = folder.lexically_normal();
  if (path == "." || path.filename() == "..") return std::filesystem::canonical(path);
  return path.has_filename() ? path : path.parent_path();
}

ExportFolder::ExportFolder(const Path& out, const Path& scratch)
    : out_(out), in_scratch_(!scratch.empty()), part_(part_of(out, scratch)), lock_(part_) {
  clear();
}

ExportFolder::~ExportFolder() {
  std::error_code ignored;
  if (in_scratch_ || !done_) std::filesystem::remove_all(part_, ignored);
  if (begun_ && !done_) std::filesystem::remove_all(out_, ignored);
}

void ExportFolder::clear() const {
  for (const auto& entry : std::filesystem::directory_iterator(part_))
    if (entry.path().filename() != kExportLock) std::filesystem::remove_all(entry.path());
}

void ExportFolder::put(const std::string& file) {
  if (!in_scratch_) return;
  if (!begun_) make_fresh_folder(out_);
  begun_ = true;
  make_folder((out_ / file).parent_path());
  copy_content(part_ / file, out_ / file);
  (void)sweep_folder(part_ / file);
}

void ExportFolder::finish() {
  if (!in_scratch_) rename_to_out();
  done_ = true;
}

void ExportFolder::finish_in_place_of_old() {
  sync_folder(part_);
  replace_folder(part_, out_);
  done_ = true;
  remove_lock();
}

void ExportFolder::rename_to_out() const {
  sync_folder(part_);
  std::error_code error;
  std::filesystem::rename(part_, out_, error);
  if (error)
    throw IoError(fmt::format("cannot rename {} to {}: {}", part_.string(), out_.string(), error.message()));
  remove_lock();
}

void ExportFolder::remove_lock() const {
  std::error_code ignored;
  std::filesystem::remove(out_ / kExportLock, ignored);
  sync_folder(out_.parent_path());
}

}  // namespace thermal
