#pragma once

#include <vector>

#include "dataset/clip_maker.h"
#include "io/files.h"
#include "scene/material.h"

namespace thermal {

/// The clips that paths mean. A folder is one clip's passes with its manifest.json, or holds such folders, as the passes
/// folder of a dataset does; files and patterns of one folder (group_passes()) are one clip. `manifest`, unless empty, is
/// used instead of the only one's. Manifests come back with all their frames, gaps of a sequence among them.
/// ConfigError for what is not there, and for files that are named where the manifest lists them; IoError for a missing
/// manifest; DataError for one that cannot be meant or names a material that is not there, for names that cannot be put
/// in order, and where two are of one clip.
[[nodiscard]] std::vector<ClipPasses> find_passes(const std::vector<Path>& named, const Path& manifest,
                                                  const MaterialLibrary& materials, const Path& home);

}  // namespace thermal
