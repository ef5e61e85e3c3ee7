#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "io/json_file.h"

namespace thermal {

/// Path of a clip's camera, as far as recorded in frames.jsonl.
struct FlightTrack {
  std::string clip;
  std::vector<std::array<double, 16>> camera_to_world;  ///< row-major; of the frames that have one
  std::vector<double> agl_m;                            ///< of the same frames; empty unless all have one
};

/// Indices of x, y and z in camera_to_world.
inline constexpr std::size_t kX = 3, kY = 7, kZ = 11;

/// Reads a clip's frames.jsonl; a clip without poses gives a track without points. DataError with file and line.
[[nodiscard]] FlightTrack read_track(const Path& file, const std::string& clip);

/// About `most` of `count` indices, evenly spaced, including the first and the last.
[[nodiscard]] std::vector<std::size_t> spread(std::size_t count, std::size_t most);

/// The ground seen from the track's middle frame (see seen_ground); empty where unknown.
[[nodiscard]] std::vector<std::array<double, 2>> seen_halfway(const FlightTrack& track, const Json& config);

}  // namespace thermal
