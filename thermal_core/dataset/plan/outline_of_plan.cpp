#include <algorithm>
#include <cmath>
#include <map>

#include "dataset/passes/outline.h"

namespace thermal {
namespace {

constexpr double kWalkingMPerS = 1.5;  // of actors

/// Of a config's clips, those cut from its flights included: config files state them, or leave them at 12 m/s.
std::map<std::string, double> speeds_of_clips_m_s(const Config& config) {
  constexpr double kUsualMPerS = 12;
  std::map<std::string, double> speeds_m_s;
  for (const Json& clip : config.resolved.at("clips"))
    speeds_m_s[clip.at("id")] = clip.value(Json::json_pointer("/flight/speed_m_s"), kUsualMPerS);
  return speeds_m_s;
}

}  // namespace

SceneOutline outline_of(const Config& config, const DatasetPlan& plan, const MaterialLibrary& materials) {
  SceneOutline outline = empty_outline(config);
  for (const auto& [name, share] : plan.cover_shares)
    outline.covers.push_back({.material = &materials.find(name, "plan: covers"), .share = share});
  if (config.engine != Engine::embree &&
      std::ranges::any_of(outline.covers, [](const auto& cover) { return cover.material->mirrors(); }))
    outline.impossible.emplace("mirror", "the engine blender does not trace what water mirrors");
  add_actors({plan.actor_materials.begin(), plan.actor_materials.end()}, materials, outline);
  ViewingConditions conditions(config);
  std::map<std::string, const ClipConfig*> configs;
  for (const ClipConfig& clip : config.clips) configs[clip.id] = &clip;
  const std::map<std::string, double> speeds_m_s = speeds_of_clips_m_s(config);
  for (const ClipPlan& clip : plan.clips) {
    const ClipConfig& own = *configs.at(clip.id);
    const ClipSettings& settings = settings_of(config, own);
    conditions.add(own, clip.mean_agl_m, clip.mean_look_angle_deg, settings.camera);
    const double px_per_s =
        settings.camera.fx_px * (speeds_m_s.at(clip.id) + kWalkingMPerS) / std::max(1.0, clip.mean_agl_m);
    outline.smear_px = std::max(outline.smear_px, px_per_s * settings.sensor.time_constant_s);
  }
  outline.conditions = conditions.list(outline, materials);
  return outline;
}

}  // namespace thermal
