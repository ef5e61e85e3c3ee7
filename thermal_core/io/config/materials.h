#pragma once

#include <string>

#include "heat/body/body_heat.h"
#include "heat/surface/material_heat.h"
#include "io/assets.h"
#include "io/json/file.h"
#include "io/system/files.h"
#include "scene/material.h"

namespace thermal {

/// Reads what heats a part, an object "heat" of a material: its kind, and the keys of that kind; keys that are left out
/// have the kind's defaults. `json` must have passed the schema. ConfigError with `where` for keys of other kinds and
/// values outside of their domain.
[[nodiscard]] BodyHeat read_body_heat(const Json& json, const std::string& where);

/// Reads `heat` of a material, checked and filled in by its schema. ConfigError with `where` unless it has one of
/// ground, leaves and slab.
[[nodiscard]] MaterialHeat read_material_heat(const Json& json, const std::string& where);

/// Reads every *.json of assets/materials; the file's name is the material's. ConfigError with file, key
/// and value if one violates configs/schema/material.schema.json.
[[nodiscard]] MaterialLibrary read_materials(const Assets& assets);

}  // namespace thermal
