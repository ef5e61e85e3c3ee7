#include "dataset/plan/ground_planning.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "io/bake/baked_files.h"
#include "io/bake/ground_maps_file.h"
#include "raycast/ground_light.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

void add_once(const SunPath& path, std::vector<SunPath>& paths) {
  if (std::ranges::count(paths, path) == 0) paths.push_back(path);
}

/// Of an earlier plan: none if they cannot be read.
std::vector<SunPath> paths_in(const Path& folder, const Assets& assets) {
  try {
    return sun_paths_of_maps(folder, assets);
  } catch (const Error&) {  // missing, of another version, or damaged: they are made again
    return {};
  }
}

}  // namespace

bool needs_ground_maps(const Config& config) { return config.physical && config.heat_balance; }

std::vector<SunPath> sun_paths(const Config& config) {
  std::vector<SunPath> paths;
  for (const FlownWeather& flown : flown_weather(config)) add_once(flown.weather.day.sun, paths);
  return paths;
}

bool has_needed_ground_maps(const Path& folder, const Config& config, const Assets& assets) {
  if (!needs_ground_maps(config)) return true;
  const std::vector<SunPath> known = paths_in(folder, assets);
  return std::ranges::all_of(sun_paths(config),
                             [&known](const SunPath& path) { return std::ranges::count(known, path) > 0; });
}

std::vector<GroundView> ground_views(const Path& folder, const DatasetPlan& plan, const BakedScene& scene,
                                     const Assets& assets) {
  std::vector<GroundView> views;
  for (const ClipPlan& clip : plan.clips) {
    const BakedTrack track = read_baked_track(folder, clip.id, scene, assets);
    Manifest manifest;
    manifest.camera = track.camera.value_or(scene.camera);
    manifest.overscan_px = scene.view_margin_px;
    views.push_back({.camera = pixels_camera(manifest),
                     .camera_to_world = {track.camera_to_world.begin(), track.camera_to_world.end()}});
  }
  return views;
}

bool uses_ground_maps(const Path& folder, const Config& config) {
  return needs_ground_maps(config) && has_ground_maps(folder);
}

std::shared_ptr<const GroundMaps> read_needed_ground_maps(const Path& folder, const Config& config,
                                                          const Assets& assets) {
  if (!uses_ground_maps(folder, config)) return nullptr;
  const BakedScene scene = read_baked_scene(folder, assets);
  return std::make_shared<const GroundMaps>(read_ground_maps(folder, scene.ground, assets));
}

void add_ground_maps(const Path& folder, const Path& scratch, const Config& config, const DatasetPlan& plan,
                     const Assets& assets, const std::function<void(const Progress&)>& show) {
  std::vector<SunDay> days;
  for (const SunPath& path : sun_paths(config)) days.push_back({.path = path, .sun = sun_hours(path)});
  const auto show_cells = [&show](int done, int total) {
    if (show) show({.clip = "ground maps", .done = done, .total = total});
  };
  const BakedScene scene = read_baked_scene(folder, assets);
  std::optional<std::vector<GroundView>> views;
  if (!config.poses_all) views = ground_views(folder, plan, scene, assets);
  write_ground_maps(make_ground_maps(scene, days, views, show_cells), folder, scratch);
}

}  // namespace thermal
