#pragma once

#include <string>

#include "io/assets.h"
#include "io/json/file.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Fills in missing values of `camera` and `sensor` from the config's preset, a file in assets/sensors. `schema` is
/// that of configs. ConfigError if the preset is unknown (starting with `where`, "night.json: ") or violates the schema (starting with
/// its file). Faults of the document itself are left to the schema check.
void apply_preset(Json& document, const Json& schema, const std::string& where, const Assets& assets);

/// The sensor of a resolved config. ConfigError, starting with `where`, if the spectral response is unknown.
[[nodiscard]] SensorParameters read_sensor(const Json& document, const std::string& where,
                                           const Assets& assets);

}  // namespace thermal
