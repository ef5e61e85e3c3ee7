#include "dataset/reports/flights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "dataset/plan/planning.h"
#include "io/base64.h"
#include "io/child_process.h"
#include "io/jpeg.h"
#include "io/passing_folder.h"

namespace thermal {
namespace {

/// A centimetre is finer than a pixel of any map.
double rounded_m(double value_m) { return std::round(100 * value_m) / 100; }

Json track_json(const FlightTrack& track, const Json& config) {
  constexpr std::size_t kMostPoints = 300;
  Json points = Json::array();
  for (const std::size_t k : spread(track.camera_to_world.size(), kMostPoints)) {
    const auto& pose = track.camera_to_world[k];
    points.push_back({rounded_m(pose[kX]), rounded_m(pose[kY])});
  }
  Json json = {{"clip", track.clip}, {"points_m", std::move(points)}, {"seen_m", Json::array()}};
  if (track.agl_m.empty()) return json;
  const auto [least, most] = std::minmax_element(track.agl_m.begin(), track.agl_m.end());
  json["agl_m"] = {rounded_m(*least), rounded_m(*most)};
  for (const auto& [x_m, y_m] : seen_halfway(track, config))
    json["seen_m"].push_back({rounded_m(x_m), rounded_m(y_m)});
  return json;
}

/// Input of draw_map.py: positions below the camera with the height of ground or water, then the positions it sees.
Json ground_points(const std::vector<FlightTrack>& tracks, const Json& config) {
  constexpr std::size_t kMostPoints = 400;
  Json points = Json::array();
  for (const FlightTrack& track : tracks) {
    for (const std::size_t k : spread(track.camera_to_world.size(), kMostPoints / tracks.size() + 2)) {
      const auto& pose = track.camera_to_world[k];
      points.push_back({pose[kX], pose[kY], pose[kZ] - track.agl_m[k]});
    }
    for (const auto& [x_m, y_m] : seen_halfway(track, config)) points.push_back({x_m, y_m, nullptr});
  }
  return points;
}

Json absent(const std::string& why) { return {{"absent", why}}; }

Json picture(const Path& folder, const char* name, const Json& answer) {
  constexpr int kMostPx = 1024;
  Json window = answer.at(name);
  window["picture"] =
      "data:image/jpeg;base64," + base64_of(as_jpeg(folder / (std::string(name) + ".png"), kMostPx));
  return window;
}

Json drawn(const Json& answer, const Path& folder) {
  constexpr double kMostOffM = 0.5;  // roads' cuts and rounding differ by centimetres; other places by metres
  const double off_m = answer.at("off_m");
  if (off_m > kMostOffM) {
    return absent(fmt::format(
        "The ground of the config's place differs by up to {:.1f} m from the ground below the camera, so "
        "the passes are not of that place, and it is not drawn.",
        off_m));
  }
  return {{"place", picture(folder, "place", answer)}, {"window", picture(folder, "window", answer)}};
}

Json map_of(const std::vector<FlightTrack>& tracks, const Json& config, const Path& home) {
  const Path python = find_python();
  if (python.empty()) return absent("The place could not be drawn: no python3 on PATH.");
  const PassingFolder folder;
  write_file_atomically(folder.path() / "config.json", to_text(config));
  write_file_atomically(folder.path() / "points.json", ground_points(tracks, config).dump());
  const std::string at = folder.path().string();
  const Output output =
      run_program({python.string(), "-I", "-B", (home / "blender_scripts" / "draw_map.py").string(),
                   "--config", at + "/config.json", "--points", at + "/points.json", "--out", at});
  if (output.status.signal != 0 || output.status.code != 0) {
    const std::string why = printable(output.last_words());
    return absent("The place could not be drawn: " + (why.empty() ? output.status.in_words() : why));
  }
  return drawn(parse_json(output.out, "draw_map.py"), folder.path());
}

bool has_heights(const FlightTrack& track) {
  return !track.agl_m.empty() && track.agl_m.size() == track.camera_to_world.size();
}

}  // namespace

Json flight_figures(const std::vector<FlightTrack>& tracks, const Json& config, const Path& home) {
  std::vector<FlightTrack> flown;
  Json json = {{"tracks", Json::array()}};
  for (const FlightTrack& track : tracks) {
    json["tracks"].push_back(track_json(track, config));
    if (!track.camera_to_world.empty()) flown.push_back(track);
  }
  if (flown.empty()) {
    json["map"] = absent("The passes of this dataset have no camera poses.");
  } else if (!std::all_of(flown.begin(), flown.end(), has_heights)) {
    json["map"] = absent(
        "The passes do not say how high the camera flew above ground, so it is unknown whether they show the "
        "place of the config, and it is not drawn.");
  } else {
    json["map"] = map_of(flown, config, home);
  }
  return json;
}

}  // namespace thermal
