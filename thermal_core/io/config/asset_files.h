#pragma once

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// Checks the files of species, plants, structures and sites that a resolved scene needs against
/// configs/schema/asset.schema.json. ConfigError with file, key and value. Names without a file are left to the planner,
/// which knows where they stand.
void check_asset_files(const Json& scene, const Assets& assets);

}  // namespace thermal
