#pragma once

#include <vector>

#include "dataset/reports/flight_track.h"
#include "io/json_file.h"

namespace thermal {

/// Tracks and the map below them, as JSON: `tracks` (clip, points_m, agl_m from and to, seen_m: the ground that the
/// middle frame shows) and `map`: pictures as data URIs with their places in metres, or else `absent`, a sentence that
/// says why there is none.
/// blender_scripts/draw_map.py draws it from the config; it is shown only if the camera's heights fit its ground.
[[nodiscard]] Json flight_figures(const std::vector<FlightTrack>& tracks, const Json& config,
                                  const Path& home);

}  // namespace thermal
