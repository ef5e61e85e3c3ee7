#include "dataset/reports/days.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "heat/surface/heat_report.h"
#include "imaging/typical_heat.h"
#include "io/config/config.h"
#include "io/config/materials.h"

namespace thermal {
namespace {

constexpr double kStepH = 0.5;
constexpr std::size_t kMostDays = 4;  // of clips with weather of their own

std::optional<Config> readable(const Json& config, const Assets& assets) {
  try {
    return resolve_config(config, "config", assets);
  } catch (const ConfigError&) {
    return std::nullopt;  // of another version
  }
}

template <typename TemperatureAt>
Json over_the_day(const TemperatureAt& temperature_k) {
  constexpr double kCentikelvin = 100;
  Json values = Json::array();
  for (double hour = 0; hour <= 24; hour += kStepH)
    values.push_back(std::round(kCentikelvin * temperature_k(hour)) / kCentikelvin);
  return values;
}

}  // namespace

Json day_figures(const Json& config, const Assets& assets) {
  Json days = Json::array();
  const std::optional<Config> read = readable(config, assets);
  if (!read || !read->physical || !read->heat_balance) return days;
  const auto materials = heat_of_materials(read_materials(assets));
  std::vector<FlownWeather> flown = flown_weather(*read);
  flown.resize(std::min(flown.size(), kMostDays));
  for (const auto& [season, weather, flown_h] : flown) {
    const DayWeather& day = weather.day;
    Json by_material = Json::object();
    for (const HeatCurve& curve : open_curves(day, materials))
      by_material[curve.material] = over_the_day([&](double hour) { return curve.day.at_k(hour); });
    days.push_back({{"season", season_name(season)},
                    {"flown_h", flown_h},
                    {"step_h", kStepH},
                    {"air_k", over_the_day([&](double hour) { return air_temperature_k(day, hour); })},
                    {"materials_k", std::move(by_material)}});
  }
  return days;
}

}  // namespace thermal
