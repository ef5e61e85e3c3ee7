#include "io/config/weather.h"

#include <chrono>

#include <fmt/format.h>

#include "base/error.h"
#include "heat/weather/forcing.h"
#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

std::chrono::year_month_day date_of(const std::string& text) {
  using namespace std::chrono;
  return {year(std::stoi(text.substr(0, 4))), month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
          day(static_cast<unsigned>(std::stoi(text.substr(8, 2))))};
}

int day_of_year(const std::chrono::year_month_day& date) {
  using namespace std::chrono;
  return static_cast<int>((sys_days(date) - sys_days(date.year() / January / 1)).count()) + 1;
}

double hours_of(const std::string& time) {
  return std::stoi(time.substr(0, 2)) + std::stoi(time.substr(3, 2)) / 60.0;
}

void replace(const Json& weather, const char* key, double& value) {
  if (weather.contains(key)) value = weather[key];
}

/// Air of the day: given by its hours, by its extremes, or by its temperature at `time` and the season's swing.
void read_air(const Json& weather, double solar_h, DayWeather& day) {
  if (weather.contains("air_hourly_k")) day.air_hourly_k = weather["air_hourly_k"].get<std::vector<double>>();
  replace(weather, "air_min_k", day.air_min_k);
  replace(weather, "air_max_k", day.air_max_k);
  if (!weather.contains("air_temperature_k")) return;
  const double warmer_k = weather["air_temperature_k"].get<double>() - air_temperature_k(day, solar_h);
  day.air_min_k += warmer_k;
  day.air_max_k += warmer_k;
}

void read_vapour(const Json& weather, const Air& air, double solar_h, DayWeather& day) {
  if (weather.contains("dew_point_k")) {
    day.vapour_hpa = saturation_hpa(weather["dew_point_k"]);
  } else if (weather.contains("relative_humidity") || weather.contains("air_temperature_k")) {
    day.vapour_hpa = air.relative_humidity * saturation_hpa(air_temperature_k(day, solar_h));
  }
}

}  // namespace

Weather read_weather(const Json& weather, Season season) {
  Weather read = weather_of(season);
  replace(weather, "air_temperature_k", read.air.temperature_k);
  replace(weather, "relative_humidity", read.air.relative_humidity);
  replace(weather, "cloud_fraction", read.air.cloud_fraction);
  replace(weather, "inversion_k", read.air.inversion_k);
  read.inversion_by_balance = !weather.contains("inversion_k");
  if (weather.contains("vehicle_stopped_s")) read.vehicle_stopped_s = weather["vehicle_stopped_s"];
  replace(weather, "cold_pool_k", read.cold_pool_k);
  DayWeather& day = read.day;
  if (weather.contains("date")) day.sun.day_of_year = day_of_year(date_of(weather["date"]));
  if (weather.contains("time")) read.solar_h = hours_of(weather["time"]);
  replace(weather, "latitude_deg", day.sun.latitude_deg);
  replace(weather, "elevation_m", day.elevation_m);
  replace(weather, "wind_m_s", day.night_wind_m_s);
  if (weather.contains("wind_m_s")) day.day_wind_m_s = day.night_wind_m_s + 2;
  replace(weather, "day_wind_m_s", day.day_wind_m_s);
  replace(weather, "rain_days_ago", day.rain_days_ago);
  if (weather.contains("cloud_hourly")) {
    day.cloud_hourly = weather["cloud_hourly"].get<std::vector<double>>();
    read.air.cloud_fraction = cloud_fraction_at(day, read.solar_h);
  }
  day.cloud_fraction = read.air.cloud_fraction;
  read_air(weather, read.solar_h, day);
  read_vapour(weather, read.air, read.solar_h, day);
  return read;
}

Weather at_moment(Weather weather, double later_s) {
  weather.solar_h += later_s / 3600;
  const Forcing forcing = forcing_at(weather.day, weather.solar_h);
  weather.air.temperature_k = forcing.air_k;
  weather.air.relative_humidity = forcing.vapour_hpa / saturation_hpa(forcing.air_k);
  weather.air.cloud_fraction = cloud_fraction_at(weather.day, weather.solar_h);
  return weather;
}

void check_weather(const Json& weather, std::initializer_list<Season> seasons,
                   std::vector<std::string>& faults) {
  const auto add = [&faults](const std::string& key, const std::string& value, const char* unit,
                             const std::string& rule) {
    faults.push_back(fault("weather." + key, value, unit, rule));
  };
  if (weather.contains("date") && !date_of(weather["date"]).ok())
    return add("date", fmt::format("\"{}\"", weather["date"].get<std::string>()), "",
               "a day of the calendar");
  const bool extremes = weather.contains("air_min_k") || weather.contains("air_max_k");
  const bool hourly = weather.contains("air_hourly_k");
  if (extremes && hourly)
    return add("air_hourly_k", "24 numbers", "", "none beside weather.air_min_k and weather.air_max_k");
  if (weather.contains("air_temperature_k") && (extremes || hourly))
    return add("air_temperature_k", fmt::format("{}", weather["air_temperature_k"].get<double>()), "K",
               "none beside the air of the whole day");
  if (weather.contains("cloud_hourly") && weather.contains("cloud_fraction"))
    return add("cloud_hourly", "24 numbers", "", "none beside weather.cloud_fraction");
  if (weather.contains("dew_point_k") && weather.contains("relative_humidity"))
    return add("dew_point_k", fmt::format("{}", weather["dew_point_k"].get<double>()), "K",
               "none beside weather.relative_humidity");
  for (const Season season : seasons) {
    const Weather one = read_weather(weather, season);
    try {
      one.day.validate();
    } catch (const ConfigError& error) {
      return faults.emplace_back(error.what()), void();
    }
    const double air_k = air_temperature_k(one.day, one.solar_h);
    if (weather.contains("dew_point_k") && weather["dew_point_k"].get<double>() > air_k)
      return add("dew_point_k", fmt::format("{}", weather["dew_point_k"].get<double>()), "K",
                 fmt::format("at most that of the air at weather.time, {:.2f} K", air_k));
  }
}

}  // namespace thermal
