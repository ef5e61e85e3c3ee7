#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/json/file.h"

namespace thermal {

/// The picture's corners projected onto level ground agl_m below the camera: x, y [m] of the four, clockwise from the
/// top left. Empty if a corner shows the sky, or ground more than 5 agl_m away. camera_to_world (4 x 4, row-major): x
/// right, y down, z forward to x east, y north, z up. `camera`: a config's; lens distortion is ignored.
[[nodiscard]] std::vector<std::array<double, 2>> seen_ground(const std::array<double, 16>& camera_to_world,
                                                             double agl_m, const Json& camera);

/// Path of a clip's camera, as far as recorded in frames.jsonl.
struct FlightTrack {
  std::string clip;
  std::vector<std::array<double, 16>> camera_to_world;  ///< row-major; of the frames that have one
  std::vector<double> agl_m;                            ///< of the same frames; empty unless all have one
};

inline constexpr std::size_t kX = 3;   ///< index of x in camera_to_world
inline constexpr std::size_t kY = 7;   ///< of y
inline constexpr std::size_t kZ = 11;  ///< of z

/// Reads a clip's frames.jsonl; a clip without poses gives a track without points. DataError with file and line.
[[nodiscard]] FlightTrack read_track(const Path& file, const std::string& clip);

/// About `most` of `count` indices, evenly spaced, including the first and the last.
[[nodiscard]] std::vector<std::size_t> spread(std::size_t count, std::size_t most);

/// The ground seen from the track's middle frame (see seen_ground); empty where unknown.
[[nodiscard]] std::vector<std::array<double, 2>> seen_halfway(const FlightTrack& track, const Json& document);

/// Tracks and the map below them, as JSON: `tracks` (clip, points_m, agl_m from and to, seen_m: the ground that the
/// middle frame shows) and `map`: pictures as data URIs with their positions in metres, or otherwise `absent`, a
/// sentence with the reason. The map is drawn by blender_scripts/draw_map.py from the config, and shown only if the
/// camera's heights match its ground.
[[nodiscard]] Json flight_figures(const std::vector<FlightTrack>& tracks, const Json& document,
                                  const Assets& assets);

}  // namespace thermal
