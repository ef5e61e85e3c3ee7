#include "heat/weather/day_weather.h"

#include <algorithm>
#include <string>

#include <fmt/core.h>

#include "base/error.h"
#include "base/ranges.h"
#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

void check(const std::string& key, double value, const char* unit, double low, double high) {
  require_range("weather." + key, value, unit, low, high);
}

void check_hours(const std::string& key, const std::vector<double>& hourly, const char* unit, double low,
                 double high) {
  if (hourly.size() != 24)
    throw ConfigError(fault("weather." + key, fmt::format("{} numbers", hourly.size()), "",
                            "24 numbers, of 0:00 to 23:00"));
  for (std::size_t hour = 0; hour < hourly.size(); ++hour)
    check(fmt::format("{}[{}]", key, hour), hourly[hour], unit, low, high);
}

constexpr double kColdestK = 200;
constexpr double kHottestK = 340;

double check_air(const DayWeather& weather) {
  if (weather.air_hourly_k.empty()) {
    check("air_min_k", weather.air_min_k, "K", kColdestK, kHottestK);
    check("air_max_k", weather.air_max_k, "K", kColdestK, kHottestK);
    if (weather.air_min_k <= weather.air_max_k) return weather.air_max_k;
    throw ConfigError(fault("weather.air_min_k", fmt::format("{}", weather.air_min_k), "K",
                            fmt::format("at most weather.air_max_k, {} K", weather.air_max_k)));
  }
  check_hours("air_hourly_k", weather.air_hourly_k, "K", kColdestK, kHottestK);
  return *std::ranges::max_element(weather.air_hourly_k);
}

}  // namespace

void DayWeather::validate() const {
  sun.validate();
  const double warmest_k = check_air(*this);
  check("elevation_m", elevation_m, "m", -500, 9000);
  check("vapour_hpa", vapour_hpa, "hPa", 0, saturation_hpa(warmest_k));
  check("wind_m_s", night_wind_m_s, "m/s", 0, 60);
  check("day_wind_m_s", day_wind_m_s, "m/s", 0, 60);
  check("cloud_fraction", cloud_fraction, "", 0, 1);
  if (!cloud_hourly.empty()) check_hours("cloud_hourly", cloud_hourly, "", 0, 1);
  check("rain_days_ago", rain_days_ago, "", 0, 10000);
}

}  // namespace thermal
