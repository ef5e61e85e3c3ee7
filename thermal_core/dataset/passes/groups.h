#pragma once

#include <string>
#include <vector>

#include "io/system/files.h"
#include "io/system/sequence.h"
#include "scene/manifest.h"

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

}  // namespace thermal
