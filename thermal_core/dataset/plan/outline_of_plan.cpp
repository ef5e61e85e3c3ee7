#include <algorithm>
#include <cmath>
#include <map>

#include "dataset/passes/outline.h"

namespace thermal {
namespace {

constexpr double kWalkingMPerS = 1.5;  // of actors

/// Of a clip's flight. Configs state it, or leave it at 12 m/s.
double speed_m_s(const Json& config, const ClipPlan& clip) {
  constexpr double kUsual = 12;
  const std::string list = clip.of_flight.empty() ? "clips" : "flights";
  const std::string& id = clip.of_flight.empty() ? clip.id : clip.of_flight;
  if (!config.contains(list)) return kUsual;
  for (const Json& entry : config[list]) {
    if (entry.value("id", "") != id) continue;
    const Json& flight = entry.contains("flight") ? entry["flight"] : entry;
    return flight.value("speed_m_s", kUsual);
  }
  return kUsual;
}

}  // namespace

SceneOutline outline_of(const Config& config, const DatasetPlan& plan, const MaterialLibrary& materials) {
  SceneOutline outline = empty_outline(config);
  for (const auto& [name, share] : plan.cover_shares)
    outline.covers.push_back({.material = &materials.find(name, "plan: covers"), .share = share});
  if (config.engine != Engine::embree && plan.cover_shares.contains("water"))
    outline.impossible.emplace("mirror", "the engine blender does not trace what water mirrors");
  add_actors({plan.actor_materials.begin(), plan.actor_materials.end()}, materials, outline);
  Nights nights(config);
  std::map<std::string, Season> seasons;
  for (const ClipConfig& clip : config.clips) seasons[clip.id] = clip.season;
  for (const ClipPlan& clip : plan.clips) {
    nights.add(seasons.at(clip.id), std::max(1.0, std::round(clip.mean_agl_m)),
               std::round(clip.mean_look_angle_deg), config.camera);
    const double px_per_s =
        config.camera.fx_px * (speed_m_s(plan.config, clip) + kWalkingMPerS) / std::max(1.0, clip.mean_agl_m);
    outline.smear_px = std::max(outline.smear_px, px_per_s * config.sensor.time_constant_s);
  }
  outline.nights = nights.list(outline, materials);
  return outline;
}

}  // namespace thermal
