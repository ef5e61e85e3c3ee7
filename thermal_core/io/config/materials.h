#pragma once

#include "io/system/files.h"
#include "scene/material.h"

namespace thermal {

/// Reads every *.json of assets/materials below `home`; the file's name is the material's. ConfigError with file, key
/// and value if one violates configs/schema/material.schema.json.
[[nodiscard]] MaterialLibrary read_materials(const Path& home);

}  // namespace thermal
