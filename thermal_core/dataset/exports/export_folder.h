#pragma once

#include <string>

#include "io/system/files.h"
#include "io/system/folder_lock.h"

namespace thermal {

/// A folder's path with a name at its end, without a trailing slash, so that OUT.part is beside OUT.
[[nodiscard]] Path named_folder(const Path& folder);

/// The folder in which an export, or the page of `veldt view`, is made; nothing of it stays unless it was finished. It
/// is OUT.part, which becomes OUT, or NAME.part in a scratch folder: then each file is copied to OUT when it is complete,
/// and removed, because OUT need not be a place that can rename or lock. Whoever reads OUT then takes it for complete
/// when it has the file that was put last.
class ExportFolder {
 public:
  /// What a killed run has left in the folder is removed. ConfigError if what is there is not of such a run;
  /// TryAgainError if another run is at work in it.
  ExportFolder(const Path& out, const Path& scratch);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  /// Where the next files are made.
  [[nodiscard]] const Path& path() const noexcept { return part_; }

  /// Takes a complete file, relative to path(). The first one that is copied to OUT replaces what is there.
  void put(const std::string& file);

  /// After the last file. IoError if OUT is a folder with anything in it.
  void finish();

  /// The same, without a scratch folder, in place of what is at OUT, in one step: see replace_folder().
  void finish_in_place_of_old();

 private:
  void clear() const;
  void rename_to_out() const;
  void remove_lock() const;

  Path out_;
  bool in_scratch_;
  Path part_;
  FolderLock lock_;
  bool begun_ = false;  ///< OUT is ours
  bool done_ = false;
};

}  // namespace thermal
