#pragma once

#include <string>

#include "io/assets.h"
#include "io/config/config.h"

namespace thermal::python {

/// Completes some sections of a config to a whole config, checked and with defaults, with a dummy clip "clip" of one
/// frame. `sections`: a JSON object with any of camera, sensor, weather, terms and labels. ConfigError, starting with
/// `name`.
[[nodiscard]] Config config_of_sections(const std::string& sections, const std::string& name,
                                        const Assets& assets);

}  // namespace thermal::python
