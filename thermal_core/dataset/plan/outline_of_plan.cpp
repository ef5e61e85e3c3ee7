#include <algorithm>
#include <cmath>
#include <map>

#include "dataset/passes/outline.h"

namespace thermal {

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
  }
  outline.nights = nights.list(outline, materials);
  return outline;
}

}  // namespace thermal
