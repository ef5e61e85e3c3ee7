#include <algorithm>
#include <cmath>
#include <map>

#include "dataset/passes/outline.h"

namespace thermal {
namespace {

constexpr double kWalkingMPerS = 1.5;  // of actors

/// Speeds of the clips and flights of a plan's config, which states them, or leaves them at 12 m/s.
class SpeedsOfFlights {
 public:
  explicit SpeedsOfFlights(const Json& config) {
    for (const char* list : {"clips", "flights"})
      for (const Json& entry : config.value(list, Json::array()))
        speeds_m_s_[list][entry.value("id", "")] =
            entry.value(Json::json_pointer("/flight/speed_m_s"), kUsualMPerS);
  }

  [[nodiscard]] double of(const ClipPlan& clip) const {
    const bool is_own = clip.of_flight.empty();
    const auto& speeds_m_s = speeds_m_s_.at(is_own ? "clips" : "flights");
    const auto found = speeds_m_s.find(is_own ? clip.id : clip.of_flight);
    return found == speeds_m_s.end() ? kUsualMPerS : found->second;
  }

 private:
  static constexpr double kUsualMPerS = 12;
  std::map<std::string, std::map<std::string, double>> speeds_m_s_ = {{"clips", {}}, {"flights", {}}};
};

}  // namespace

SceneOutline outline_of(const Config& config, const DatasetPlan& plan, const MaterialLibrary& materials) {
  SceneOutline outline = empty_outline(config);
  for (const auto& [name, share] : plan.cover_shares)
    outline.covers.push_back({.material = &materials.find(name, "plan: covers"), .share = share});
  if (config.engine != Engine::embree && plan.cover_shares.contains("water"))
    outline.impossible.emplace("mirror", "the engine blender does not trace what water mirrors");
  add_actors({plan.actor_materials.begin(), plan.actor_materials.end()}, materials, outline);
  Nights nights(config);
  std::map<std::string, const ClipConfig*> configs;
  for (const ClipConfig& clip : config.clips) configs[clip.id] = &clip;
  const SpeedsOfFlights speeds(plan.config);
  for (const ClipPlan& clip : plan.clips) {
    const ClipConfig& own = *configs.at(clip.id);
    const ClipSettings& settings = settings_of(config, own);
    nights.add(own, clip.mean_agl_m, clip.mean_look_angle_deg, settings.camera);
    const double px_per_s =
        settings.camera.fx_px * (speeds.of(clip) + kWalkingMPerS) / std::max(1.0, clip.mean_agl_m);
    outline.smear_px = std::max(outline.smear_px, px_per_s * settings.sensor.time_constant_s);
  }
  outline.nights = nights.list(outline, materials);
  return outline;
}

}  // namespace thermal
