#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/plausible.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/outline/outline.h"
#include "io/pass_reader.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// Result for the first readable frame: a clip's frames are alike, and unreadable ones are reported when they are
/// converted. `fault` receives the first fault.
template <typename ViewDirection>
auto of_a_frame(const ClipPasses& source, std::string& fault, const ViewDirection& look)
    -> std::optional<decltype(look(0))> {
  const auto frames = static_cast<int>(source.manifest.frames.size());
  for (int frame = 0; frame < frames; ++frame) {
    try {
      return look(frame);
    } catch (const DataError& error) {
      if (fault.empty()) fault = error.what();
    } catch (const IoError& error) {
      if (fault.empty()) fault = error.what();
    }
  }
  return std::nullopt;
}

/// "frames[3] has no camera_to_world"; empty if every frame has one.
std::string pose_lacking(const Manifest& manifest) {
  for (std::size_t i = 0; i < manifest.frames.size(); ++i) {
    if (!manifest.frames[i].camera_to_world) return fmt::format("frames[{}] has no camera_to_world", i);
  }
  return "";
}

bool shows_mirrors(const Manifest& manifest, const MaterialLibrary& materials) {
  const auto mirrors = [&materials](const auto& entry) {
    const auto found = materials.all().find(entry.material);
    return found != materials.all().end() && found->second.mirrors();
  };
  return std::ranges::any_of(manifest.objects, mirrors) || std::ranges::any_of(manifest.materials, mirrors);
}

/// Checks the inputs of each term. The first missing input is reported; of several clips, that of the first.
void add_impossible(const ClipPasses& source, const PassesView& view, const DatasetSpec& spec,
                    const MaterialLibrary& materials, SceneOutline& outline) {
  const PassNeeds& planes = *view.planes;
  const std::string depth = planes.depth ? "" : "no depth";
  const std::string normals = planes.normals ? "" : "no normals";
  const std::string poses = pose_lacking(source.manifest);
  const auto add = [&](const std::string& term, const std::string& lacking) {
    if (!lacking.empty())
      outline.impossible.emplace(term, fmt::format("clip {}: {}", source.manifest.clip, lacking));
  };
  if (spec.heat_balance) {
    const std::string maps = view.has_ground_maps ? "" : "no maps of the ground";
    add("place", !maps.empty() ? maps : depth.empty() ? poses : depth);
    add("facing", normals.empty() ? poses : normals);
  }
  add("variation", depth.empty() ? poses : depth);
  add("sky", normals.empty() ? poses : normals);
  add("angular", normals.empty() ? poses : normals);
  add("path", depth);
  if (spec.settings->sensor.time_constant_s > 0) add("smear", depth.empty() ? poses : depth);
  if (shows_mirrors(source.manifest, materials))
    add("mirror", planes.mirrored ? poses : "no mirrored planes");
}

/// Cosine of the angle of incidence of a ray on level ground; without a pose, as if perpendicular.
double ground_cosine(const ManifestFrame& frame, const LensPoint& ray, double length) {
  if (!frame.camera_to_world) return 1;
  const auto& m = *frame.camera_to_world;
  return -(m[8] * ray.x + m[9] * ray.y + m[10]) / length;
}

/// Viewing directions of five by five rays, with ranges from the depth plane.
std::vector<SceneOutline::ViewDirection> directions_in(const Plane<float>& depth_m, const Manifest& manifest,
                                                       const ManifestFrame& frame) {
  const CameraIntrinsics camera = passes_camera(manifest);
  constexpr int kRays = 5;
  constexpr double kLeastCosine = 0.01;  // nearer to the horizon counts as sky
  std::vector<SceneOutline::ViewDirection> view_directions;
  for (int row = 0; row < kRays; ++row) {
    for (int column = 0; column < kRays; ++column) {
      const int x = (depth_m.width_px() - 1) * column / (kRays - 1);
      const int y = (depth_m.height_px() - 1) * row / (kRays - 1);
      const float depth = depth_m.at(x, y);
      if (!kDistanceM.holds(static_cast<double>(depth))) continue;
      const LensPoint ray = unproject(camera, manifest.lens, {x + 0.5, y + 0.5});
      const double length = std::hypot(ray.x, ray.y, 1);
      const double cosine = ground_cosine(frame, ray, length);
      if (cosine <= kLeastCosine) continue;
      view_directions.push_back({.range_m = static_cast<double>(depth) * length,
                                 .ground_cosine = cosine,
                                 .axis_cosine = 1 / length});
    }
  }
  return view_directions;
}

/// Adds the mean height and angle over the frames that state their height, as for planned clips.
void add_stated_height(const Manifest& manifest, const ClipSpec& clip, ViewingConditions& conditions) {
  constexpr double kStraightDown = 90;
  double sum_agl_m = 0;
  double sum_look_deg = 0;
  double count = 0;
  for (const ManifestFrame& frame : manifest.frames) {
    if (!frame.agl_m) continue;
    sum_agl_m += *frame.agl_m;
    sum_look_deg += frame.look_angle_deg.value_or(kStraightDown);
    ++count;
  }
  if (count > 0) conditions.add(clip, sum_agl_m / count, sum_look_deg / count, manifest.camera);
}

/// Viewing directions of a clip's camera, from a frame's depths; empty without depths.
std::vector<SceneOutline::ViewDirection> directions_of(const ClipPasses& source, const PassReader& reader) {
  const auto look = [&](int number) {
    const Passes passes =
        reader.read(file_of(source, number), {.depth = true, .normals = false, .actors = false});
    return directions_in(passes.depth_m, source.manifest,
                         source.manifest.frames[static_cast<std::size_t>(number)]);
  };
  std::string ignored;
  return of_a_frame(source, ignored, look).value_or(std::vector<SceneOutline::ViewDirection>());
}

/// The longest displacement of an actor between two frames [m].
double longest_step_m(const ManifestFrame& before, const ManifestFrame& now) {
  double longest = 0;
  for (const ActorPose& pose : now.actors) {
    const auto from = std::ranges::find(before.actors, pose.index, &ActorPose::index);
    if (from == before.actors.end()) continue;
    longest = std::max(longest, std::hypot(pose.position_m[0] - from->position_m[0],
                                           pose.position_m[1] - from->position_m[1],
                                           pose.position_m[2] - from->position_m[2]));
  }
  return longest;
}

/// Motion of the picture by the poses [px / s]: the fastest translation over level ground, also of an actor, and the
/// fastest rotation.
double motion_px_per_s(const Manifest& manifest,
                       const std::vector<SceneOutline::ViewDirection>& view_directions) {
  constexpr double kUsualHeightM = 100;
  double fastest = 0;
  for (std::size_t i = 1; i < manifest.frames.size(); ++i) {
    const ManifestFrame& frame = manifest.frames[i];
    if (!frame.camera_to_world || !manifest.frames[i - 1].camera_to_world) continue;
    const auto& now = *frame.camera_to_world;
    const auto& before = *manifest.frames[i - 1].camera_to_world;
    const double height_m =
        frame.agl_m.value_or(view_directions.empty() ? kUsualHeightM : view_directions.front().range_m);
    const double moved_m = std::hypot(now[3] - before[3], now[7] - before[7], now[11] - before[11]) +
                           longest_step_m(manifest.frames[i - 1], frame);
    const double turned = std::hypot(now[2] - before[2], now[6] - before[6], now[10] - before[10]);
    fastest = std::max(fastest, moved_m / std::max(1.0, height_m) + turned);
  }
  return fastest * manifest.frame_rate_hz * manifest.camera.fx_px;
}

/// Whether a frame states the height of its camera.
bool states_height(const Manifest& manifest) {
  return std::ranges::any_of(manifest.frames,
                             [](const ManifestFrame& frame) { return frame.agl_m.has_value(); });
}

void add_ground(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline) {
  for (const std::string& name : names) {
    outline.covers.push_back({.material = &materials.find(name, "manifest: material"),
                              .share = (1 - kActorShare) / static_cast<double>(names.size())});
  }
}

}  // namespace

PassesView view_passes(const ClipPasses& source, bool view_directions) {
  PassesView view = {
      .planes = {}, .view_directions = {}, .has_ground_maps = has_ground_beside(source.folder)};
  try {
    const PassReader reader = reader_for(source);
    std::string fault;
    view.planes =
        of_a_frame(source, fault, [&](int frame) { return reader.planes_in(file_of(source, frame)); });
    if (!view.planes)
      view.fault = source.bad_frames == BadFrames::fail
                       ? fault
                       : no_frame_left(fault, static_cast<int>(source.manifest.frames.size()));
    if (view_directions && view.planes && view.planes->depth && !states_height(source.manifest))
      view.view_directions = directions_of(source, reader);
  } catch (const DataError& error) {  // the manifest makes every frame unreadable
    view.fault = error.what();
  }
  return view;
}

PassesView view_planes(const Manifest& manifest, const Passes& first) {
  PassesView view = {.planes = PassNeeds{.depth = !first.depth_m.empty(),
                                         .normals = !first.normal.front().empty(),
                                         .actors = !first.actor_index.empty(),
                                         .mirrored = !first.mirrored.empty()},
                     .view_directions = {}};
  if (view.planes->depth && !states_height(manifest))
    view.view_directions = directions_in(first.depth_m, manifest, manifest.frames.front());
  return view;
}

SceneOutline outline_of(const DatasetSpec& spec, const MaterialLibrary& materials,
                        const std::vector<ClipPasses>& sources, const std::vector<PassesView>& views) {
  SceneOutline outline = empty_outline(spec);
  ViewingConditions conditions(spec);
  std::set<std::string> ground;
  std::set<std::string> actors;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Manifest& manifest = sources[i].manifest;
    for (const ManifestObject& object : manifest.objects)
      (object.object_class == ObjectClass::actor ? actors : ground).insert(object.material);
    const ClipSpec& clip = spec.clips[i];
    add_stated_height(manifest, clip, conditions);
    if (!spec.physical) continue;
    if (views[i].planes) add_impossible(sources[i], views[i], spec, materials, outline);
    conditions.add(clip, views[i].view_directions);
    outline.smear_px = std::max(outline.smear_px, motion_px_per_s(manifest, views[i].view_directions) *
                                                      clip.settings->sensor.time_constant_s);
  }
  add_ground(ground, materials, outline);
  add_actors(actors, materials, outline);
  outline.conditions = conditions.list(outline, materials);
  return outline;
}

}  // namespace thermal
