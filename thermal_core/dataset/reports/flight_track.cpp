#include "dataset/reports/flight_track.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/reports/seen_ground.h"

namespace thermal {
namespace {

void add_frame(const Json& frame, FlightTrack& track) {
  if (!frame.contains("camera_to_world")) return;
  track.camera_to_world.push_back(frame["camera_to_world"].get<std::array<double, 16>>());
  if (frame.contains("agl_m")) track.agl_m.push_back(frame["agl_m"]);
}

}  // namespace

FlightTrack read_track(const Path& file, const std::string& clip) {
  FlightTrack track{.clip = clip, .camera_to_world = {}, .agl_m = {}};
  std::istringstream lines(read_file(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      add_frame(Json::parse(line), track);
    } catch (const Json::exception& error) {
      throw DataError(fmt::format("{}:{}: not a frame of a clip: {}", file.string(), number, error.what()));
    }
  }
  if (track.agl_m.size() != track.camera_to_world.size()) track.agl_m.clear();
  return track;
}

std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> places;
  const std::size_t steps = std::min(count, most);
  for (std::size_t k = 0; k < steps; ++k) places.push_back(steps == 1 ? 0 : k * (count - 1) / (steps - 1));
  return places;
}

std::vector<std::array<double, 2>> seen_halfway(const FlightTrack& track, const Json& config) {
  if (track.agl_m.empty()) return {};
  const std::size_t middle = track.agl_m.size() / 2;
  return seen_ground(track.camera_to_world[middle], track.agl_m[middle], config.at("camera"));
}

}  // namespace thermal
