#pragma once

#include <vector>

#include "dataset/clip_maker.h"
#include "io/files.h"
#include "scene/material.h"

namespace thermal {

/// The clips that folders mean: each is one clip's passes with its manifest.json, or holds such folders, as the
/// passes folder of a dataset does. `manifest`, unless empty, is used instead of the only folder's.
/// ConfigError for what is no folder; DataError for a manifest that cannot be meant or names a material that is
/// not there, and where two folders are of one clip.
[[nodiscard]] std::vector<ClipPasses> find_passes(const std::vector<Path>& folders, const Path& manifest,
                                                  const MaterialLibrary& materials, const Path& home);

}  // namespace thermal
