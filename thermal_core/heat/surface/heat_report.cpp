#include "heat/surface/heat_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/parallel.h"

namespace thermal {
namespace {

using Materials = std::map<std::string, MaterialHeat>;

constexpr double kSeenInCrown = 0.6;

/// Weather and sky of one variant of a report.
struct Conditions {
  DayWeather weather;
  double more_sky_w_m2 = 0;
  bool even_air = false;  ///< the same temperature at all heights
};

std::vector<Forcing> forcing_of(const Conditions& conditions, int steps) {
  std::vector<Forcing> day = forcing_of_day(conditions.weather, steps);
  for (Forcing& forcing : day) forcing.sky_w_m2 += conditions.more_sky_w_m2;
  return day;
}

/// The day of a level, open piece of a material.
SurfaceDay open_day(const MaterialHeat& heat, const GroundHeat& soil, const Conditions& conditions,
                    const HeatSteps& steps) {
  const std::vector<Forcing> forcing = forcing_of(conditions, steps.per_day);
  SurfaceExposure exposure = {.moisture = moisture_after_rain(conditions.weather.rain_days_ago)};
  const auto* leaves = std::get_if<LeavesHeat>(&heat);
  if (leaves == nullptr || leaves->is_cover) return day_of(heat, soil, exposure, {.forcing = forcing}, steps);
  std::vector<double> ground_k;
  if (!conditions.even_air) ground_k = day_of(soil, soil, exposure, {.forcing = forcing}, steps).surface_k;
  exposure.sky_view = exposure.sunlit = kSeenInCrown;
  return day_of(heat, soil, exposure, {.forcing = forcing, .ground_k = ground_k}, steps);
}

const GroundHeat& ground_below(const Materials& materials, const MaterialHeat& heat) {
  const auto* leaves = std::get_if<LeavesHeat>(&heat);
  return std::get<GroundHeat>(materials.at(leaves == nullptr ? "soil" : leaves->ground));
}

// --- inputs -----------------------------------------------------------------------------------------------------------

struct WeatherChange {
  std::string name;
  std::function<void(DayWeather&)> apply;
};

std::vector<WeatherChange> weather_changes() {
  return {{"wind + 1 m/s",
           [](DayWeather& w) {
             w.night_wind_m_s += 1;
             w.day_wind_m_s += 1;
           }},
          {"cloud + 0.5",
           [](DayWeather& w) {
             w.cloud_fraction = std::min(1.0, w.cloud_fraction + 0.5);
             for (double& cloud : w.cloud_hourly) cloud = std::min(1.0, cloud + 0.5);
           }},
          {"dew point + 3 K", [](DayWeather& w) { w.vapour_hpa *= 1.24; }},
          {"air maximum + 3 K", [](DayWeather& w) { w.air_max_k += 3; }},
          {"rain yesterday", [](DayWeather& w) { w.rain_days_ago = std::min(w.rain_days_ago, 1.0); }},
          {"30 days later", [](DayWeather& w) { w.sun.day_of_year = (w.sun.day_of_year + 29) % 365 + 1; }}};
}

DayWeather sheltered(DayWeather weather) {
  weather.night_wind_m_s *= 0.5;
  weather.day_wind_m_s *= 0.5;
  return weather;
}

// --- properties -------------------------------------------------------------------------------------------------------

/// Variants of a material's properties, each changed by one standard deviation.
std::vector<MaterialHeat> other_properties(const MaterialHeat& heat) {
  std::vector<MaterialHeat> others;
  const auto add = [&](const auto& change) {
    others.push_back(heat);
    change(others.back());
  };
  const auto surfaces = [&](const auto& change) {
    add([&](MaterialHeat& other) {
      if (auto* ground = std::get_if<GroundHeat>(&other)) {
        for (GroundProperties& state : ground->states) change(state.surface);
      } else if (auto* slab = std::get_if<SlabHeat>(&other)) {
        change(slab->properties.surface);
      }
    });
  };
  const auto grounds = [&](const auto& change) {
    add([&](MaterialHeat& other) {
      for (GroundProperties& state : std::get<GroundHeat>(other).states) change(state);
    });
  };
  const auto leaves = [&](const auto& change) {
    add([&](MaterialHeat& other) {
      for (CanopyProperties& state : std::get<LeavesHeat>(other).states) change(state);
    });
  };
  if (std::holds_alternative<LeavesHeat>(heat)) {
    leaves([](CanopyProperties& canopy) { canopy.leaf_area_index *= 1.35; });
    leaves([](CanopyProperties& canopy) { canopy.leaf_width_m *= 2; });
    leaves([](CanopyProperties& canopy) { canopy.albedo += 0.04; });
    leaves([](CanopyProperties& canopy) { canopy.emissivity -= 0.02; });
    return others;
  }
  surfaces([](SurfaceProperties& surface) { surface.albedo = std::min(1.0, surface.albedo + 0.04); });
  surfaces([](SurfaceProperties& surface) { surface.emissivity -= 0.02; });
  surfaces(
      [](SurfaceProperties& surface) { surface.roughness_m = std::min(0.5, 2.5 * surface.roughness_m); });
  surfaces([](SurfaceProperties& surface) { surface.evaporation += surface.evaporation > 0.5 ? -0.1 : 0.1; });
  if (!std::holds_alternative<GroundHeat>(heat)) return others;
  grounds([](GroundProperties& ground) { ground.conductivity_w_m_k *= 1.35; });
  grounds([](GroundProperties& ground) { ground.heat_capacity_j_m3_k *= 1.12; });
  return others;
}

std::vector<Crossover> crossovers_of(const std::vector<HeatCurve>& curves) {
  std::vector<Crossover> found;
  for (std::size_t a = 0; a < curves.size(); ++a) {
    for (std::size_t b = a + 1; b < curves.size(); ++b) {
      const auto& first = curves[a].day.surface_k;
      const auto& second = curves[b].day.surface_k;
      const std::size_t count = first.size();
      for (std::size_t i = 0; i < count; ++i) {
        const double before = first[(i + count - 1) % count] - second[(i + count - 1) % count];
        const double after = first[i] - second[i];
        if (!(before < 0 && after >= 0) && !(before > 0 && after <= 0)) continue;
        const double step = static_cast<double>(i) + before / (before - after);
        found.push_back({.solar_h = 24 * step / static_cast<double>(count),
                         .warmer = curves[after > before ? a : b].material,
                         .colder = curves[after > before ? b : a].material});
      }
    }
  }
  std::ranges::sort(found, {}, &Crossover::solar_h);
  return found;
}

}  // namespace

std::vector<HeatCurve> open_curves(const DayWeather& weather, const Materials& materials,
                                   const HeatSteps& steps) {
  weather.validate();
  std::vector<HeatCurve> curves(materials.size());
  std::ranges::transform(materials, curves.begin(), [](const auto& entry) {
    return HeatCurve{entry.first, {}};
  });
  parallel_for(curves.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const MaterialHeat& heat = materials.at(curves[i].material);
      curves[i].day = open_day(heat, ground_below(materials, heat), {weather}, steps);
    }
  });
  return curves;
}

HeatReport heat_report(const DayWeather& weather, const Materials& materials, double solar_h,
                       const HeatSteps& steps) {
  HeatReport report;
  report.curves = open_curves(weather, materials, steps);
  const std::vector<WeatherChange> changes = weather_changes();
  std::vector<const Materials::value_type*> all;
  for (const auto& entry : materials) all.push_back(&entry);
  for (const WeatherChange& change : changes) report.inputs.push_back({change.name, {}});
  std::vector<double> uncertainty_k(all.size());
  std::vector<std::vector<double>> change_k(changes.size(), std::vector<double>(all.size()));
  parallel_for(all.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [name, heat] = *all[i];
      const GroundHeat& soil = ground_below(materials, heat);
      const auto at_k = [&](const MaterialHeat& other, const Conditions& conditions) {
        return open_day(other, soil, conditions, steps).at_k(solar_h);
      };
      const double assumed_k = report.curves[i].day.at_k(solar_h);
      double variance = std::pow(at_k(heat, {weather, 10}) - assumed_k, 2);
      for (const MaterialHeat& other : other_properties(heat))
        variance += std::pow(at_k(other, {weather}) - assumed_k, 2);
      if (std::holds_alternative<LeavesHeat>(heat)) {
        variance += std::pow(at_k(heat, {sheltered(weather)}) - assumed_k, 2);
        variance += std::pow(0.5 * (at_k(heat, {.weather = weather, .even_air = true}) - assumed_k), 2);
      }
      uncertainty_k[i] = std::sqrt(variance);
      for (std::size_t c = 0; c < changes.size(); ++c) {
        Conditions conditions = {weather};
        changes[c].apply(conditions.weather);
        change_k[c][i] = at_k(heat, conditions) - assumed_k;
      }
    }
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    report.uncertainty_k[all[i]->first] = uncertainty_k[i];
    for (std::size_t c = 0; c < changes.size(); ++c)
      report.inputs[c].change_k[all[i]->first] = change_k[c][i];
  }
  report.crossovers = crossovers_of(report.curves);
  return report;
}

}  // namespace thermal
