#include "dataset/plan/ground_planning.h"

#include <algorithm>

#include "base/error.h"
#include "io/bake/baked_files.h"
#include "io/bake/ground_maps_file.h"
#include "raycast/ground_light.h"

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

bool uses_ground_maps(const Path& folder, const Config& config) {
  return needs_ground_maps(config) && has_ground_maps(folder);
}

void add_ground_maps(const Path& folder, const Path& scratch, const Config& config, const Assets& assets,
                     const std::function<void(const Progress&)>& show) {
  std::vector<SunDay> days;
  for (const SunPath& path : sun_paths(config)) days.push_back({.path = path, .sun = sun_hours(path)});
  const auto show_part = [&show](int done, int total) {
    if (show) show({.clip = "ground maps", .done = done, .total = total});
  };
  const BakedScene scene = read_baked_scene(folder, assets);
  write_ground_maps(make_ground_maps(scene, days, show_part), folder, scratch);
}

}  // namespace thermal
