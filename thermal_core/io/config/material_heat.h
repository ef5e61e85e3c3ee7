#pragma once

#include <string>

#include "heat/surface/material_heat.h"
#include "io/json/file.h"

namespace thermal {

/// Reads `heat` of a material, checked and filled in by its schema. ConfigError with `where` unless it has one of
/// ground, leaves and slab.
[[nodiscard]] MaterialHeat read_material_heat(const Json& json, const std::string& where);

}  // namespace thermal
