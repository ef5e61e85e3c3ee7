#pragma once

#include <string>

#include "heat/body/body_heat.h"
#include "io/json/file.h"

namespace thermal {

/// Reads what heats a part, an object "heat" of a material: its kind, and the keys of that kind; keys that are left out
/// have the kind's defaults. `json` must have passed the schema. ConfigError with `where` for keys of other kinds and
/// values outside of their domain.
[[nodiscard]] BodyHeat read_body_heat(const Json& json, const std::string& where);

}  // namespace thermal
