#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/passes/outline.h"
#include "io/pass_reader.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

/// Adds what the first readable frame provides: other frames of a clip are like it, and unreadable ones are reported
/// when they are converted.
template <typename Look>
auto of_a_frame(const ClipPasses& source, const Look& look) -> std::optional<decltype(look(0))> {
  const auto frames = static_cast<int>(source.manifest.frames.size());
  for (int frame = 0; frame < frames; ++frame) {
    try {
      return look(frame);
    } catch (const DataError&) {
    } catch (const IoError&) {
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

bool shows_water(const Manifest& manifest) {
  const auto is_water = [](const auto& entry) { return entry.material == "water"; };
  return std::ranges::any_of(manifest.objects, is_water) || std::ranges::any_of(manifest.materials, is_water);
}

/// What each term needs. The first missing input is reported; among several clips, that of the first.
void add_impossible(const ClipPasses& source, const PassesView& view, bool heat_balance,
                    SceneOutline& outline) {
  const PassNeeds& planes = *view.planes;
  const std::string depth = planes.depth ? "" : "no depth";
  const std::string normals = planes.normals ? "" : "no normals";
  const std::string poses = pose_lacking(source.manifest);
  const auto add = [&](const std::string& term, const std::string& lacking) {
    if (!lacking.empty())
      outline.impossible.emplace(term, fmt::format("clip {}: {}", source.manifest.clip, lacking));
  };
  if (heat_balance) {
    const std::string maps = view.has_ground_maps ? "" : "no maps of the ground";
    add("place", !maps.empty() ? maps : depth.empty() ? poses : depth);
    add("facing", normals.empty() ? poses : normals);
  }
  add("variation", depth.empty() ? poses : depth);
  add("sky", normals.empty() ? poses : normals);
  add("angular", normals.empty() ? poses : normals);
  add("path", depth);
  if (shows_water(source.manifest)) add("mirror", planes.mirrored ? poses : "no mirrored planes");
}

/// Angle of incidence of a ray on level ground; without a pose, as if perpendicular.
double ground_cosine(const ManifestFrame& frame, const LensPoint& ray, double length) {
  if (!frame.camera_to_world) return 1;
  const auto& m = *frame.camera_to_world;
  return -(m[8] * ray.x + m[9] * ray.y + m[10]) / length;
}

/// Five by five rays over the picture to their depths in the depth plane.
std::vector<SceneOutline::Look> looks_in(const Plane<float>& depth_m, const Manifest& manifest,
                                         const ManifestFrame& frame) {
  const CameraIntrinsics camera = passes_camera(manifest);
  constexpr int kRays = 5;
  constexpr double kLeastCosine = 0.01;  // nearer to the horizon counts as sky
  std::vector<SceneOutline::Look> looks;
  for (int row = 0; row < kRays; ++row) {
    for (int column = 0; column < kRays; ++column) {
      const int x = (depth_m.width_px() - 1) * column / (kRays - 1);
      const int y = (depth_m.height_px() - 1) * row / (kRays - 1);
      const float depth = depth_m.at(x, y);
      if (!(depth > 0 && depth < kSkyFromM)) continue;
      const LensPoint ray = unproject(camera, manifest.lens, {x + 0.5, y + 0.5});
      const double length = std::hypot(ray.x, ray.y, 1);
      const double cosine = ground_cosine(frame, ray, length);
      if (cosine <= kLeastCosine) continue;
      looks.push_back({.range_m = static_cast<double>(depth) * length,
                       .ground_cosine = cosine,
                       .axis_cosine = 1 / length});
    }
  }
  return looks;
}

/// A clip keeps its height and angle, so one frame is representative.
void add_told_height(const Manifest& manifest, Season season, Nights& nights) {
  const auto frame =
      std::ranges::find_if(manifest.frames, [](const ManifestFrame& one) { return one.agl_m.has_value(); });
  if (frame == manifest.frames.end()) return;
  constexpr double kStraightDown = 90;
  nights.add(season, *frame->agl_m, frame->look_angle_deg.value_or(kStraightDown), manifest.camera);
}

/// Viewing directions of a clip's camera, by the depths of a frame; empty without depths.
std::vector<SceneOutline::Look> looks_of(const ClipPasses& source, const PassReader& reader) {
  const auto look = [&](int number) {
    const Passes passes =
        reader.read(file_of(source, number), {.depth = true, .normals = false, .actors = false});
    return looks_in(passes.depth_m, source.manifest,
                    source.manifest.frames[static_cast<std::size_t>(number)]);
  };
  return of_a_frame(source, look).value_or(std::vector<SceneOutline::Look>());
}

/// Whether a frame gives the height of its camera.
bool tells_height(const Manifest& manifest) {
  return std::ranges::any_of(manifest.frames,
                             [](const ManifestFrame& frame) { return frame.agl_m.has_value(); });
}

PassesView view_of(const ClipPasses& source) {
  const PassReader reader = reader_for(source);
  const auto planes_in = [&](int frame) { return reader.planes_in(file_of(source, frame)); };
  PassesView view = {.planes = of_a_frame(source, planes_in),
                     .looks = {},
                     .has_ground_maps = has_ground_beside(source.folder)};
  if (view.planes && view.planes->depth && !tells_height(source.manifest))
    view.looks = looks_of(source, reader);
  return view;
}

void add_ground(const std::set<std::string>& names, const MaterialLibrary& materials, SceneOutline& outline) {
  for (const std::string& name : names) {
    outline.covers.push_back({.material = &materials.find(name, "manifest: material"),
                              .share = (1 - kActorShare) / static_cast<double>(names.size())});
  }
}

}  // namespace

std::vector<PassesView> view_passes(const std::vector<ClipPasses>& sources) {
  std::vector<PassesView> views;
  for (const ClipPasses& source : sources) views.push_back(view_of(source));
  return views;
}

SceneOutline outline_of(const Config& config, const MaterialLibrary& materials,
                        const std::vector<ClipPasses>& sources, const std::vector<PassesView>& views) {
  SceneOutline outline = empty_outline(config);
  Nights nights(config);
  std::set<std::string> ground;
  std::set<std::string> actors;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Manifest& manifest = sources[i].manifest;
    for (const ManifestObject& object : manifest.objects)
      (object.object_class == ObjectClass::actor ? actors : ground).insert(object.material);
    const Season season = config.clip(manifest.clip, "manifest: clip").season;
    add_told_height(manifest, season, nights);
    if (!config.physical) continue;
    if (views[i].planes) add_impossible(sources[i], views[i], config.heat_balance, outline);
    nights.add(season, views[i].looks);
  }
  add_ground(ground, materials, outline);
  add_actors(actors, materials, outline);
  outline.nights = nights.list(outline, materials);
  return outline;
}

}  // namespace thermal
