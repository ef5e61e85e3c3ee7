#pragma once

#include <string>

#include "io/json_file.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Fills what a config says nothing of in `camera` and `sensor` from its preset, a file in assets/sensors.
/// `schema` is that of configs. ConfigError if there is no such preset (starting with `name`) or if it is not what the
/// schema wants (starting with its file). What is wrong with the document itself is left for the schema to say.
void apply_preset(Json& document, const Json& schema, const std::string& name, const Path& home);

/// The sensor of a resolved config. ConfigError, starting with `name`, if there is no such spectral response.
[[nodiscard]] SensorParameters read_sensor(const Json& document, const std::string& name, const Path& home);

}  // namespace thermal
