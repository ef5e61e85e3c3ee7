#include "dataset/reports/flights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/clip_files.h"
#include "dataset/plan/planner.h"
#include "io/assets.h"
#include "io/config/lens.h"
#include "io/image/pictures.h"
#include "io/system/child_process.h"
#include "io/system/sha256.h"
#include "io/system/temporary.h"

namespace thermal {

std::vector<std::array<double, 2>> seen_ground(const std::array<double, 16>& camera_to_world, double agl_m,
                                               const Json& camera) {
  constexpr double kFarthest = 5;
  const auto& m = camera_to_world;
  const CameraIntrinsics pinhole = read_intrinsics(camera);
  const double left = -pinhole.cx_px / pinhole.fx_px;
  const double up = -pinhole.cy_px / pinhole.fy_px;
  const double right = (pinhole.width_px - pinhole.cx_px) / pinhole.fx_px;
  const double down = (pinhole.height_px - pinhole.cy_px) / pinhole.fy_px;
  std::vector<std::array<double, 2>> corners;
  for (const auto& [x, y] : {std::array{left, up}, {right, up}, {right, down}, {left, down}}) {
    const std::array ray = {m[0] * x + m[1] * y + m[2], m[4] * x + m[5] * y + m[6],
                            m[8] * x + m[9] * y + m[10]};
    const double run = std::hypot(ray[0], ray[1]);
    if (ray[2] >= 0 || run > -kFarthest * ray[2]) return {};
    corners.push_back({m[3] - ray[0] / ray[2] * agl_m, m[7] - ray[1] / ray[2] * agl_m});
  }
  return corners;
}

namespace {

void add_frame(const Json& frame, FlightTrack& track) {
  if (!frame.contains("camera_to_world")) return;
  track.camera_to_world.push_back(frame["camera_to_world"].get<std::array<double, 16>>());
  if (frame.contains("agl_m")) track.agl_m.push_back(frame["agl_m"]);
}

}  // namespace

FlightTrack read_track(const Path& file, const std::string& clip) {
  FlightTrack track{.clip = clip, .camera_to_world = {}, .agl_m = {}};
  for_frame_lines(file, [&track](const Json& frame) { add_frame(frame, track); });
  return track;
}

std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> places;
  const std::size_t steps = std::min(count, most);
  for (std::size_t k = 0; k < steps; ++k) places.push_back(steps == 1 ? 0 : k * (count - 1) / (steps - 1));
  return places;
}

/// The `camera` of a config, with a clip's changes.
Json camera_of_clip(const Json& document, const std::string& id) {
  Json camera = document.at("camera");
  for (const Json& clip : document.value("clips", Json::array()))
    if (clip.value("id", "") == id && clip.contains("camera")) camera.merge_patch(clip["camera"]);
  return camera;
}

std::vector<std::array<double, 2>> seen_halfway(const FlightTrack& track, const Json& document) {
  if (track.agl_m.empty()) return {};
  const std::size_t middle = track.agl_m.size() / 2;
  return seen_ground(track.camera_to_world[middle], track.agl_m[middle],
                     camera_of_clip(document, track.clip));
}

namespace {

/// A centimetre is finer than a pixel of any map.
double rounded_m(double value_m) { return std::round(100 * value_m) / 100; }

Json track_json(const FlightTrack& track, const Json& document) {
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
  for (const auto& [x_m, y_m] : seen_halfway(track, document))
    json["seen_m"].push_back({rounded_m(x_m), rounded_m(y_m)});
  return json;
}

/// Input of draw_map.py: positions below the camera with the height of ground or water, then the corners of its view.
Json ground_points(const std::vector<FlightTrack>& tracks, const Json& document) {
  constexpr std::size_t kMostPoints = 400;
  Json points = Json::array();
  for (const FlightTrack& track : tracks) {
    for (const std::size_t k : spread(track.camera_to_world.size(), kMostPoints / tracks.size() + 2)) {
      const auto& pose = track.camera_to_world[k];
      points.push_back({pose[kX], pose[kY], pose[kZ] - track.agl_m[k]});
    }
    for (const auto& [x_m, y_m] : seen_halfway(track, document)) points.push_back({x_m, y_m, nullptr});
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
  constexpr double kMostOffM = 0.5;  // road cuts and rounding differ by centimetres; other terrain by metres
  const double off_m = answer.at("off_m");
  if (off_m > kMostOffM) {
    return absent(fmt::format(
        "The ground of the config's place differs by up to {:.1f} m from the ground below the camera, so "
        "the passes are not of that place, and it is not drawn.",
        off_m));
  }
  return {{"place", picture(folder, "place", answer)}, {"window", picture(folder, "window", answer)}};
}

Json map_of(const std::vector<FlightTrack>& tracks, const Json& document, const Assets& assets) {
  const Path python = find_python();
  if (python.empty()) return absent("The place could not be drawn: no python3 on PATH.");
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "config.json", to_text(document));
  write_file_atomically(folder.path() / "points.json", ground_points(tracks, document).dump());
  const std::string at = folder.path().string();
  const Output output = run_program({python.string(), "-I", assets.script("draw_map.py").string(), "--config",
                                     at + "/config.json", "--points", at + "/points.json", "--out", at});
  if (output.status.signal != 0 || output.status.code != 0) {
    const std::string why = printable(output.last_error_line());
    return absent("The place could not be drawn: " + (why.empty() ? output.status.in_words() : why));
  }
  return drawn(parse_json(output.out, "draw_map.py"), folder.path());
}

bool has_heights(const FlightTrack& track) {
  return !track.agl_m.empty() && track.agl_m.size() == track.camera_to_world.size();
}

}  // namespace

Json flight_figures(const std::vector<FlightTrack>& tracks, const Json& document, const Assets& assets) {
  std::vector<FlightTrack> flown;
  Json json = {{"tracks", Json::array()}};
  for (const FlightTrack& track : tracks) {
    json["tracks"].push_back(track_json(track, document));
    if (!track.camera_to_world.empty()) flown.push_back(track);
  }
  if (flown.empty()) {
    json["map"] = absent("The passes of this dataset have no camera poses.");
  } else if (!std::all_of(flown.begin(), flown.end(), has_heights)) {
    json["map"] = absent(
        "The passes do not say how high the camera flew above ground, so it is unknown whether they show the "
        "place of the config, and it is not drawn.");
  } else {
    json["map"] = map_of(flown, document, assets);
  }
  return json;
}

}  // namespace thermal
