#pragma once

#include "io/json/file.h"
#include "sensor/analogue_link.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// `sensor.processing` of a config, checked and filled in.
[[nodiscard]] ProcessingParameters read_processing(const Json& processing);

/// `output.link`, likewise.
[[nodiscard]] AnalogueLinkParameters read_link(const Json& link);

}  // namespace thermal
