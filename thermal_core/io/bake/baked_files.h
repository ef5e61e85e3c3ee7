#pragma once

#include "io/assets.h"
#include "io/system/files.h"
#include "scene/baked_scene.h"

namespace thermal {

/// Reads the baked scene of a plan: scene.json and scene.bin in `folder`. DataError with the file's name, the place,
/// the value and what is expected if it is of another version, truncated or inconsistent: an array outside the file, an
/// unknown index, a value that is not finite. IoError if it cannot be read.
[[nodiscard]] BakedScene read_baked_scene(const Path& folder, const Assets& assets);

/// Reads a clip's track, `tracks/<clip>.json` and .bin; errors as above, also if it does not belong to the scene.
[[nodiscard]] BakedTrack read_baked_track(const Path& folder, const std::string& clip,
                                          const BakedScene& scene, const Assets& assets);

}  // namespace thermal
