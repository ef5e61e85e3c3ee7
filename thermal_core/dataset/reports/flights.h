#pragma once

#include <vector>

#include "dataset/reports/flight_track.h"
#include "io/json_file.h"

namespace thermal {

/// Tracks and the map below them, as JSON: `tracks` (clip, points_m, agl_m from and to, seen_m: the ground that the
/// middle frame shows) and `map`: pictures as data URIs with their positions in metres, or otherwise `absent`, a
/// sentence with the reason. The map is drawn by blender_scripts/draw_map.py from the config, and shown only if the
/// camera's heights match its ground.
[[nodiscard]] Json flight_figures(const std::vector<FlightTrack>& tracks, const Json& config,
                                  const Path& home);

}  // namespace thermal
