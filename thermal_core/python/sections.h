#pragma once

#include <string>

#include "io/assets.h"
#include "io/config/config.h"

namespace thermal::python {

/// Some sections of a config as a whole one, checked and filled in: with a clip "clip" of one frame, which nothing is
/// made of. `sections`: a JSON object with any of camera, sensor, weather, terms and labels. ConfigError, starting with
/// `name`.
[[nodiscard]] Config config_of_sections(const std::string& sections, const std::string& name,
                                        const Assets& assets);

}  // namespace thermal::python
