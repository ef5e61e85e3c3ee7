#include "dataset/clip/heat_days.h"

#include "imaging/typical_heat.h"
#include "io/bake/ground_maps_file.h"

namespace thermal {
namespace {

Path folder_of_clips(const Path& clip_passes) {
  return std::filesystem::absolute(clip_passes).lexically_normal().parent_path();
}

constexpr std::size_t kMostDays = 16;  // kept: clips with the same weather are often made one after the other

}  // namespace

bool has_ground_beside(const Path& clip_passes) {
  return std::filesystem::exists(folder_of_clips(clip_passes) / "ground.json");
}

std::shared_ptr<const HeatOfDay> HeatDays::of(const DayWeather& weather) {
  const std::scoped_lock lock(mutex_);
  for (const auto& day : days_) {
    if (day->weather() == weather) return day;
  }
  if (days_.size() == kMostDays) days_.erase(days_.begin());
  return days_.emplace_back(std::make_shared<const HeatOfDay>(weather, heat_of_materials(materials_)));
}

std::shared_ptr<const GroundMaps> HeatDays::ground_beside(const Path& clip_passes) {
  const Path folder = folder_of_clips(clip_passes);
  const std::scoped_lock lock(mutex_);
  const auto [found, is_new] = grounds_.try_emplace(folder);
  if (is_new && assets_ && has_ground_beside(clip_passes))
    found->second = std::make_shared<const GroundMaps>(read_ground_maps(folder, *assets_));
  return found->second;
}

}  // namespace thermal
