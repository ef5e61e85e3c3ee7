#pragma once

#include <string>
#include <vector>

#include "io/json_file.h"
#include "scene/lens_distortion.h"

namespace thermal {

/// The lens of a config's `camera.distortion`.
[[nodiscard]] LensDistortion read_distortion(const Json& json);

/// Writes what the lens needs as the config's render.overscan_px, where that says nothing of it. Adds a fault if it
/// says too little, or if no overscan is enough.
void fill_overscan(Json& document, std::vector<std::string>& faults);

}  // namespace thermal
