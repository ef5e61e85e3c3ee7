#pragma once

#include <array>
#include <vector>

#include "io/json_file.h"

namespace thermal {

/// Positions of the picture's corners on the ground, if that were level and agl_m below the camera: x, y [m] of the
/// four, clockwise from the top left. Empty if a corner shows the sky, or ground more than 5 agl_m away.
/// camera_to_world (4 x 4, row-major): x right, y down, z forward to x east, y north, z up. `camera`: a config's;
/// lens distortion is ignored.
[[nodiscard]] std::vector<std::array<double, 2>> seen_ground(const std::array<double, 16>& camera_to_world,
                                                             double agl_m, const Json& camera);

}  // namespace thermal
