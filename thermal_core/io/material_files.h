#pragma once

#include "io/files.h"
#include "scene/material.h"

namespace thermal {

/// Every *.json of assets/materials below `home`, the file's name being the material's. ConfigError naming file, key and value if
/// one is not what configs/schema/material.schema.json says.
[[nodiscard]] MaterialLibrary read_materials(const Path& home);

}  // namespace thermal
