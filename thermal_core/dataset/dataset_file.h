#pragma once

#include <string>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// Locations in a dataset's folder.
struct Layout {
  Path root;
  Path scratch = {};  ///< for unfinished clips and passes; empty: in `root`

  [[nodiscard]] Path dataset_json() const { return root / "dataset.json"; }
  /// Whether a dataset exists here.
  [[nodiscard]] bool is_begun() const { return std::filesystem::exists(dataset_json()); }
  [[nodiscard]] Path annotations_json() const { return root / "annotations.json"; }
  [[nodiscard]] Path clips() const { return root / "clips"; }
  [[nodiscard]] Path clip(const std::string& id) const { return clips() / id; }
  /// Folder in which a clip is built before it is renamed.
  [[nodiscard]] Path unfinished_clip(const std::string& id) const {
    return (scratch.empty() ? clips() : scratch) / (id + ".part");
  }
  [[nodiscard]] Path passes() const { return (scratch.empty() ? root : scratch) / "passes"; }
  [[nodiscard]] Path passes(const std::string& id) const { return passes() / id; }
  [[nodiscard]] Path passes_config() const { return passes() / "config.json"; }
  /// Marks a clip whose passes could not be converted: the next run renders them again.
  [[nodiscard]] Path unusable(const std::string& id) const { return passes(id) / "unusable.txt"; }
  /// Folder for incomplete files, which are then moved to `root`.
  [[nodiscard]] const Path& workplace() const { return scratch.empty() ? root : scratch; }
  [[nodiscard]] Path plan() const { return root / "plan"; }
  [[nodiscard]] Path preview() const { return root / "preview"; }
};

/// "000012.png"
[[nodiscard]] std::string frame_name(int frame);

/// "clips/a/ir8/000012.png" -> "clips/a/ir16/000012.png"
[[nodiscard]] std::string ir16_file(const std::string& ir8_file);

/// "000012.exr"
[[nodiscard]] std::string passes_name(int frame);

/// Reads dataset.json of an untrusted dataset, checking its format, version, and the ids of its clips, which become
/// names of folders. DataError with file, key and value if it is not a dataset's, or of a version other than 1, if
/// `clips` is not a list of objects with `id` and `status`, if an id is not a name (RelativeName::part_of), or if two
/// are equal; IoError if it cannot be read.
[[nodiscard]] Json read_dataset_file(const Path& root);

}  // namespace thermal
