#include "imaging/typical_heat.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "heat/body/body_heat.h"
#include "heat/body/fire.h"
#include "heat/surface/heat_of_day.h"
#include "heat/surface/heat_report.h"
#include "heat/surface/surface_balance.h"
#include "heat/weather/air_profile.h"
#include "imaging/actor_states.h"
#include "imaging/heated_surfaces.h"

namespace thermal {
namespace {

using Temperatures = std::map<std::string, std::map<std::string, double>>;
using Shifts = std::vector<SceneOutline::ExposureShift>;

/// State of an actor on open soil.
BodyMoment open_moment(const Weather& weather, const Temperatures& temperatures) {
  const auto soil = temperatures.find("soil");
  BodyMoment moment = {
      .around = {.forcing = forcing_at(weather.day, weather.solar_h),
                 .ground_k = soil == temperatures.end() ? weather.air.temperature_k : soil->second.at("")}};
  moment.vehicle.since_s = weather.vehicle_stopped_s.value_or(drawn_stop_s(0.5));
  return moment;
}

/// Temperatures by the heat balance on open level ground.
Temperatures open_temperatures_k(const std::vector<const Material*>& materials,
                                 const MaterialLibrary& library, const Weather& weather) {
  std::map<std::string, MaterialHeat> heat;
  for (const auto& entry : heat_of_materials(library)) {
    const std::string& name = entry.first;
    const bool wanted =
        std::ranges::any_of(materials, [&](const Material* material) { return material->name == name; });
    if (wanted || std::holds_alternative<GroundHeat>(entry.second)) heat.insert(entry);
  }
  Temperatures temperatures;
  for (const HeatCurve& curve : open_curves(weather.day, heat))
    temperatures[curve.material][""] = curve.day.at_k(weather.solar_h);
  const BodyMoment moment = open_moment(weather, temperatures);
  for (const Material* material : materials) {
    if (const BodyHeat* whole = material->body_heat_of(""))
      temperatures[material->name][""] = part_temperature_k(*whole, moment, 0.0);
    for (const auto& [part, values] : material->parts) {
      if (const BodyHeat* body = material->body_heat_of(part))
        temperatures[material->name][part] = part_temperature_k(*body, moment, 0.0);
    }
  }
  return temperatures;
}

EastNorthUp tilted(double slope_deg, double aspect_deg) {
  const double slope = slope_deg * std::numbers::pi / 180;
  const double aspect = aspect_deg * std::numbers::pi / 180;
  return {std::sin(slope) * std::sin(aspect), std::sin(slope) * std::cos(aspect), std::cos(slope)};
}

constexpr double kAspectsDeg[] = {0, 90, 180, 270};

/// Shares of the pictures that crowns and water fill.
struct Shares {
  double crowns = 0;
  double water = 0;
};

Shares shares_of(const std::vector<SceneOutline::Cover>& covers) {
  Shares shares;
  for (const SceneOutline::Cover& cover : covers) {
    if (is_crown(*cover.material)) shares.crowns += cover.share;
    if (cover.material->mirrors()) shares.water += cover.share;
  }
  return shares;
}

/// Heat columns at one moment, at few exposures.
class Columns {
 public:
  Columns(const MaterialLibrary& library, const Weather& weather)
      : library_(library),
        solar_h_(weather.solar_h),
        moisture_(moisture_after_rain(weather.day.rain_days_ago)),
        forcing_(forcing_of_day(weather.day, HeatSteps().per_day)),
        ground_k_(open_soil_k()) {}

  [[nodiscard]] SurfaceExposure open() const { return {.moisture = moisture_}; }

  [[nodiscard]] double at_k(const MaterialHeat& heat, const SurfaceExposure& exposure) const {
    const auto* leaves = std::get_if<LeavesHeat>(&heat);
    const GroundHeat& below = ground(leaves == nullptr ? "soil" : leaves->ground);
    return day_of(heat, below, exposure, {.forcing = forcing_, .ground_k = ground_k_}, {}).at_k(solar_h_);
  }

 private:
  [[nodiscard]] const GroundHeat& ground(const std::string& name) const {
    return std::get<GroundHeat>(*library_.find(name, "heat.leaves.ground").heat);
  }
  [[nodiscard]] std::vector<double> open_soil_k() const {
    const GroundHeat& soil = ground("soil");
    return day_of(soil, soil, {.moisture = moisture_}, {.forcing = forcing_}, {}).surface_k;
  }

  const MaterialLibrary& library_;
  double solar_h_;
  double moisture_;
  std::vector<Forcing> forcing_;
  std::vector<double> ground_k_;
};

/// Estimates: as much ground lies beside crowns as below them, half as much is seen between and below them, and the
/// shore that water moistens is as large as the water.
Shifts cover_places(const Columns& columns, const MaterialHeat& heat, const Shares& shares) {
  SurfaceExposure beside = columns.open();
  beside.sky_view = 0.75;
  beside.sunlit = 0.7;
  SurfaceExposure below = columns.open();
  below.sky_view = 0.3;
  below.sunlit = 0.35;
  SurfaceExposure shore = columns.open();
  shore.moisture = std::max(shore.moisture, 0.6);
  const double open_k = columns.at_k(heat, columns.open());
  return {{0, std::max(0.0, 1 - 1.5 * shares.crowns - shares.water)},
          {columns.at_k(heat, beside) - open_k, shares.crowns},
          {columns.at_k(heat, below) - open_k, 0.5 * shares.crowns},
          {columns.at_k(heat, shore) - open_k, shares.water}};
}

/// Leaves at depths below the top of a crown; a camera above sees mostly the highest (estimates).
Shifts crown_places(const Columns& columns, const LeavesHeat& heat) {
  constexpr std::pair<double, double> kDepths[] = {{0, 0.4}, {0.25, 0.3}, {0.5, 0.2}, {1, 0.1}};
  SurfaceExposure exposure = columns.open();
  exposure.sky_view = kMiddleOfCrown;
  const double middle_k = columns.at_k(heat, exposure);
  Shifts shifts;
  for (const auto& [depth_m, share] : kDepths) {
    exposure.sky_view = diffuse_through_leaves(heat.leaf_density_m2_m3 * depth_m);
    shifts.push_back({columns.at_k(heat, exposure) - middle_k, share});
  }
  return shifts;
}

/// Ground on slopes of 5 deg, and stones and trunks that face the four cardinal directions.
Shifts facing_of(const Columns& columns, const MaterialHeat& heat, bool is_body) {
  const double up_k = columns.at_k(heat, columns.open());
  Shifts shifts;
  for (const double aspect_deg : kAspectsDeg) {
    SurfaceExposure exposure = columns.open();
    exposure.normal = tilted(is_body ? 90 : 5, aspect_deg);
    shifts.push_back({columns.at_k(heat, exposure) - up_k, 0.25});
  }
  return shifts;
}

Shifts facing_of(const BodyHeat& heat, const BodyMoment& moment) {
  const double mean_k = part_temperature_k(heat, moment, 0.0);
  Shifts shifts = {{part_temperature_k(heat, moment, EastNorthUp{0, 0, 1}) - mean_k, 0.5}};
  for (const double aspect_deg : kAspectsDeg)
    shifts.push_back({part_temperature_k(heat, moment, tilted(90, aspect_deg)) - mean_k, 0.125});
  return shifts;
}

/// Excess that a camp fire gives the ground a metre away.
double fireside_k(const Surroundings& around) {
  return fireside_ground_k(CampFire(), around, GroundProperties(), around.ground_k, 1) - around.ground_k;
}

void add_shifts(const Columns& columns, const Material& material, const Shares& shares,
                SceneOutline::Conditions& viewing) {
  const MaterialHeat& heat = *material.heat;
  if (const auto* leaves = std::get_if<LeavesHeat>(&heat); leaves != nullptr && !leaves->is_cover) {
    viewing.by_exposure[material.name] = crown_places(columns, *leaves);
    return;
  }
  const auto* ground = std::get_if<GroundHeat>(&heat);
  const auto* slab = std::get_if<SlabHeat>(&heat);
  const bool is_body = (ground != nullptr && ground->is_body) || (slab != nullptr && slab->is_body);
  if (slab == nullptr || is_body) viewing.facing[material.name] = facing_of(columns, heat, is_body);
  if (slab == nullptr && !is_body) viewing.by_exposure[material.name] = cover_places(columns, heat, shares);
}

}  // namespace

void heat_conditions(const std::vector<SceneOutline::Cover>& covers, const MaterialLibrary& library,
                     SceneOutline::Conditions& viewing) {
  std::vector<const Material*> materials;
  for (const SceneOutline::Cover& cover : covers) materials.push_back(cover.material);
  viewing.heated_k = open_temperatures_k(materials, library, viewing.weather);
  const Shares shares = shares_of(covers);
  const Columns columns(library, viewing.weather);
  const BodyMoment moment = open_moment(viewing.weather, viewing.heated_k);
  if (viewing.weather.inversion_by_balance && !viewing.view_directions.empty()) {
    const SceneOutline::ViewDirection& direction = viewing.view_directions.front();
    viewing.weather.air.inversion_k =
        std::min(kLargestInversionK, StableAir(moment.around.forcing, moment.around.ground_k)
                                         .warmer_k(direction.range_m * direction.ground_cosine));
  }
  for (const Material* material : materials) {
    if (const BodyHeat* body = material->body_heat_of("")) {
      if (std::holds_alternative<FirePart>(*body)) {
        viewing.by_exposure[material->name] = {{0, 0.5}, {fireside_k(moment.around), 0.5}};
      } else {
        viewing.facing[material->name] = facing_of(*body, moment);
      }
    } else if (material->heat) {
      add_shifts(columns, *material, shares, viewing);
    }
  }
}

std::map<std::string, MaterialHeat> heat_of_materials(const MaterialLibrary& materials) {
  std::map<std::string, MaterialHeat> heat;
  for (const auto& [name, material] : materials.all()) {
    if (material.heat) heat.emplace(name, *material.heat);
    for (const auto& [part, values] : material.parts) {
      if (values.heat) heat.emplace(material.heat_name(part), *values.heat);
    }
  }
  return heat;
}

}  // namespace thermal
