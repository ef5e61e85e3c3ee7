#pragma once

#include <vector>

#include "dataset/clip/maker.h"
#include "io/assets.h"
#include "io/system/files.h"
#include "scene/material.h"

namespace thermal {

/// The clips that paths refer to. A folder is one clip's passes with its manifest.json, or holds such folders, like the
/// passes folder of a dataset; files and patterns of one folder (group_passes()) are one clip. `manifest`, unless
/// empty, replaces that of the only clip. Returned manifests list all frames, including gaps of a sequence. ConfigError
/// for paths that do not exist, and for named files where the manifest lists files; IoError for a missing manifest;
/// DataError for one that is invalid or names an unknown material, for names that cannot be sorted, and for two folders
/// with one clip.
[[nodiscard]] std::vector<ClipPasses> find_passes(const std::vector<Path>& named, const Path& manifest,
                                                  const MaterialLibrary& materials, const Assets& assets);

}  // namespace thermal
