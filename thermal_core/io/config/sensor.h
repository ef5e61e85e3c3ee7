#pragma once

#include <map>
#include <string>

#include "io/assets.h"
#include "io/json/file.h"
#include "sensor/analogue_link.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// `sensor.processing` of a config, checked and filled in.
[[nodiscard]] ProcessingParameters read_processing(const Json& processing);

/// `output.link`, likewise.
[[nodiscard]] AnalogueLinkParameters read_link(const Json& link);

/// Fills in missing values of `camera` and `sensor` from the config's preset, a file in assets/sensors, and from those
/// that it builds on (its own sensor.preset). `schema` is that of configs. ConfigError if a preset is unknown (starting
/// with `where`, "night.json: "), violates the schema or builds on itself (starting with its file), or if the document
/// gives its lens twice. Other faults of the document are left to the schema check.
void apply_preset(Json& document, const Json& schema, const std::string& where, const Assets& assets);

/// The files of assets/sensors by their presets' names, checked, each without what it builds on. ConfigError as above.
[[nodiscard]] std::map<std::string, Json> sensor_presets(const Json& schema, const Assets& assets);

/// The sensor of a resolved config. ConfigError, starting with `where`, if the spectral response is unknown.
[[nodiscard]] SensorParameters read_sensor(const Json& document, const std::string& where,
                                           const Assets& assets);

}  // namespace thermal
