#pragma once

#include <string>

#include "io/system/files.h"
#include "io/system/locks.h"

namespace thermal {

/// A folder's path without a trailing slash, so that OUT.part is beside OUT.
[[nodiscard]] Path named_folder(const Path& folder);

/// The folder in which an export, or the page of `veldt view`, is built; removed unless finished. It is OUT.part, which
/// is renamed to OUT, or NAME.part in a scratch folder: then each file is copied to OUT when it is complete, and
/// removed, because OUT may be on a file system that cannot rename or lock. Readers of OUT then treat it as complete
/// once it has the file that is put last.
class ExportFolder {
 public:
  /// Removes a killed run's leftovers. ConfigError if the folder has other contents; TryAgainError if another run is
  /// using it.
  ExportFolder(const Path& out, const Path& scratch);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  /// The folder for the next files.
  [[nodiscard]] const Path& path() const noexcept { return part_; }

  /// Accepts a complete file, relative to path(). The first one that is copied to OUT replaces existing contents.
  void put(const std::string& file);

  /// To be called after the last file. IoError if OUT is a folder with anything in it.
  void finish();

  /// The same, without a scratch folder: replaces OUT in one step, see replace_folder().
  void finish_in_place_of_old();

 private:
  void clear() const;
  void rename_to_out() const;
  void remove_lock() const;

  Path out_;
  bool in_scratch_;
  Path part_;
  FolderLock lock_;
  bool begun_ = false;  ///< whether OUT was created by this object
  bool done_ = false;
};

}  // namespace thermal
