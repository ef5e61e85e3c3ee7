#pragma once

#include <vector>

#include "io/assets.h"
#include "io/system/files.h"
#include "scene/baked_scene.h"
#include "scene/ground_maps.h"

namespace thermal {

/// The days of the maps' hours of sun, from the header alone. DataError as read_ground_maps().
[[nodiscard]] std::vector<SunPath> sun_paths_of_maps(const Path& folder, const Assets& assets);

/// Reads the ground maps of a plan: ground.json and ground.bin in `folder`. DataError with the file's name, the place,
/// the value and what is expected if they are of another version, truncated or inconsistent: an array outside the file,
/// a height that is not finite, an hour past 23, a size other than the scene's. IoError if they cannot be read.
[[nodiscard]] GroundMaps read_ground_maps(const Path& folder, const BakedGround& ground,
                                          const Assets& assets);

/// The same for maps beside passes, without a scene.
[[nodiscard]] GroundMaps read_ground_maps(const Path& folder, const Assets& assets);

/// Writes maps, ground.json last; each file is complete or unchanged. `scratch` is a folder for incomplete files, on
/// the same disk. IoError with the file and the system's reason; TryAgainError if the disk is full.
void write_ground_maps(const GroundMaps& maps, const Path& folder, const Path& scratch);

}  // namespace thermal
