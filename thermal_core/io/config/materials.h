#pragma once

#include "io/assets.h"
#include "io/system/files.h"
#include "scene/material.h"

namespace thermal {

/// Reads every *.json of assets/materials; the file's name is the material's. ConfigError with file, key
/// and value if one violates configs/schema/material.schema.json.
[[nodiscard]] MaterialLibrary read_materials(const Assets& assets);

}  // namespace thermal
