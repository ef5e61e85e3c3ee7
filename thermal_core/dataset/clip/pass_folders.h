#pragma once

#include <string>
#include <vector>

#include "dataset/clip/maker.h"
#include "io/assets.h"
#include "io/system/files.h"
#include "io/system/sequence.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// Passes given together: a folder, or files in it.
struct PassesGroup {
  Path folder;
  std::vector<FrameName> files;  ///< empty: the folder itself is given
  std::string named;             ///< the first path given, verbatim
};

/// Resolves paths: folders, and files or patterns of file names ("r/f_####.exr", "r/f_%06d.exr", "r/*.exr"), grouped by
/// folder, in the order of the first of each. An existing file is found by its name, even if that contains wildcards.
/// ConfigError for paths that do not exist, patterns that match nothing, and invalid patterns.
[[nodiscard]] std::vector<PassesGroup> group_passes(const std::vector<Path>& named);

/// Assigns files to frames: those given, or those that the manifest lists or has a pattern for. Without either, all
/// the passes of the folder, if `take_all`. `file` is the manifest's, for messages. ConfigError for given files where
/// the manifest lists files; DataError without any of these, and for names that cannot be sorted.
[[nodiscard]] FrameSequence frames_of(const PassesGroup& group, const Manifest& manifest, const Path& file,
                                      bool take_all);

/// All the passes of a group without a manifest. DataError if there are none.
[[nodiscard]] FrameSequence frames_of(const PassesGroup& group);

/// Identity of a clip's passes without reading their pixels: SHA-256 of the manifest's document, and the name and size
/// of every frame's file and of the side-car files of its cryptomatte. Copies have the same identity.
[[nodiscard]] std::string identity_of(const ClipPasses& passes);

/// Whether a clip with this record was made from other passes: their identity_sha256 differs, or one of these files was
/// written after `record_file`, its clip.json. True for a record without identity.
[[nodiscard]] bool has_changed(const ClipPasses& passes, const std::string& made_from_sha256,
                               const Path& record_file);

/// The clips that paths refer to. A folder is one clip's passes with its manifest.json, or holds such folders, like the
/// passes folder of a dataset; files and patterns of one folder (group_passes()) are one clip. `manifest`, unless
/// empty, replaces that of the only clip. Returned manifests list all frames, including gaps of a sequence. ConfigError
/// for paths that do not exist, and for named files where the manifest lists files; IoError for a missing manifest;
/// DataError for one that is invalid or names an unknown material, for names that cannot be sorted, and for two folders
/// with one clip.
[[nodiscard]] std::vector<ClipPasses> find_passes(const std::vector<Path>& named, const Path& manifest,
                                                  const MaterialLibrary& materials, const Assets& assets);

}  // namespace thermal
