#pragma once

#include <string>
#include <vector>

#include "io/files.h"
#include "io/sequence.h"
#include "scene/manifest.h"

namespace thermal {

/// Passes that are named together: a folder, or files in it.
struct PassesGroup {
  Path folder;
  std::vector<FrameName> files;  ///< empty: the folder itself is named
  std::string named;             ///< the first that was named, as it was
};

/// What paths mean: folders, and files or patterns of files' names ("r/f_####.exr", "r/f_%06d.exr", "r/*.exr"), which
/// are put together by their folder, in the order of the first of each. A file that is there is meant by its name,
/// whatever letters are in it.
/// ConfigError for what is not there, matches nothing, or is a pattern that cannot be meant.
[[nodiscard]] std::vector<PassesGroup> group_passes(const std::vector<Path>& named);

/// Which files are whose frames: those that are named, or those that the manifest lists or has a pattern for. With
/// neither, all the passes of the folder, if `take_all`. `file` is the manifest's, for faults.
/// ConfigError for files that are named where the manifest lists them; DataError where there is nothing to go by, and
/// for names that cannot be put in order.
[[nodiscard]] FrameSequence frames_of(const PassesGroup& group, const Manifest& manifest, const Path& file,
                                      bool take_all);

/// All the passes of a group without a manifest. DataError if there are none.
[[nodiscard]] FrameSequence frames_of(const PassesGroup& group);

}  // namespace thermal
