#include "heat/weather/forcing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "base/error.h"
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

namespace {

constexpr double kHalfTurn = std::numbers::pi;

double hour_of_day(double solar_h) { return solar_h - 24 * std::floor(solar_h / 24); }

/// Hours since sunrise, and the length of the day and of its afternoon lag.
double by_day(const DayWeather& weather, double since_sunrise_h, double day_h) {
  constexpr double kLagH = 1.86;
  return weather.air_min_k + (weather.air_max_k - weather.air_min_k) *
                                 std::sin(kHalfTurn * since_sunrise_h / (day_h + 2 * kLagH));
}

double by_night(const DayWeather& weather, double since_sunset_h, double day_h) {
  constexpr double kDecay = 2.2;
  const double end = std::exp(-kDecay);
  const double left = (std::exp(-kDecay * since_sunset_h / (24 - day_h)) - end) / (1 - end);
  return weather.air_min_k + (by_day(weather, day_h, day_h) - weather.air_min_k) * left;
}

double between_hours(const std::vector<double>& hourly, double hour) {
  const auto before = static_cast<std::size_t>(hour) % 24;
  const double share = hour - std::floor(hour);
  return hourly[before] + share * (hourly[(before + 1) % 24] - hourly[before]);
}

double wind_at(const DayWeather& weather, double since_sunrise_h, double day_h) {
  const bool day = since_sunrise_h > 0 && since_sunrise_h < day_h;
  const double rise = day ? std::sin(kHalfTurn * since_sunrise_h / day_h) : 0;
  return weather.night_wind_m_s + (weather.day_wind_m_s - weather.night_wind_m_s) * rise;
}

void add_sunlight(const DayWeather& weather, double cloud, Forcing& forcing) {
  constexpr double kLowestSine = 0.02;  // below it, 1 deg, the beam counts as diffuse
  const double sine = std::max(0.0, forcing.sun[2]);
  const double passed = (0.75 + 2e-5 * weather.elevation_m) * (1 - 0.65 * cloud * cloud);
  forcing.global_w_m2 = kSolarConstantWM2 * sun_nearness(weather.sun.day_of_year) * sine * passed;
  const double diffuse_share = sine > kLowestSine ? 0.2 + 0.6 * cloud : 1;
  forcing.diffuse_w_m2 = diffuse_share * forcing.global_w_m2;
  if (sine > kLowestSine) forcing.beam_w_m2 = (forcing.global_w_m2 - forcing.diffuse_w_m2) / sine;
}

}  // namespace

double broadband_sky_emissivity(double air_k, double vapour_hpa, double cloud_fraction) noexcept {
  const double w = 46.5 * vapour_hpa / air_k;
  const double clear = 1 - (1 + w) * std::exp(-std::sqrt(1.2 + 3 * w));
  return clear + 0.84 * (1 - clear) * cloud_fraction;
}

double air_temperature_k(const DayWeather& weather, double solar_h) noexcept {
  const double hour = hour_of_day(solar_h);
  if (!weather.air_hourly_k.empty()) return between_hours(weather.air_hourly_k, hour);
  const double day_h = day_length_h(weather.sun);
  if (day_h <= 0 || day_h >= 24) {
    const double swing = std::cos(2 * kHalfTurn * (hour - 14) / 24);
    return weather.air_min_k + (weather.air_max_k - weather.air_min_k) * (0.5 + 0.5 * swing);
  }
  const double since_sunrise_h = hour - (12 - day_h / 2);
  if (since_sunrise_h >= 0 && since_sunrise_h < day_h) return by_day(weather, since_sunrise_h, day_h);
  const double since_sunset_h = since_sunrise_h - day_h;
  return by_night(weather, since_sunset_h < 0 ? since_sunset_h + 24 : since_sunset_h, day_h);
}

double cloud_fraction_at(const DayWeather& weather, double solar_h) noexcept {
  return weather.cloud_hourly.empty() ? weather.cloud_fraction
                                      : between_hours(weather.cloud_hourly, hour_of_day(solar_h));
}

Forcing forcing_at(const DayWeather& weather, double solar_h) noexcept {
  const double day_h = day_length_h(weather.sun);
  Forcing forcing;
  forcing.air_k = air_temperature_k(weather, solar_h);
  forcing.wind_m_s = wind_at(weather, hour_of_day(solar_h) - (12 - day_h / 2), day_h);
  forcing.vapour_hpa = std::min(weather.vapour_hpa, saturation_hpa(forcing.air_k));
  forcing.pressure_hpa = pressure_hpa(weather.elevation_m);
  const double cloud = cloud_fraction_at(weather, solar_h);
  forcing.sky_w_m2 =
      broadband_sky_emissivity(forcing.air_k, forcing.vapour_hpa, cloud) * blackbody_w_m2(forcing.air_k);
  forcing.sun = sun_direction(weather.sun, solar_h);
  add_sunlight(weather, cloud, forcing);
  return forcing;
}

std::vector<Forcing> forcing_of_day(const DayWeather& weather, int steps) {
  std::vector<Forcing> day;
  for (int step = 1; step <= steps; ++step) day.push_back(forcing_at(weather, 24.0 * step / steps));
  return day;
}

SunMemory sun_memory(const DayWeather& weather, double solar_h) noexcept {
  constexpr double kShortestH = 0.25;  // the hour that the moment is in
  std::array<double, 24> left{};
  double sum = 0;
  for (std::size_t hour = 0; hour < left.size(); ++hour) {
    const double middle_h = static_cast<double>(hour) + 0.5;
    const Forcing forcing = forcing_at(weather, middle_h);
    const double since_h = (solar_h - middle_h) - 24 * std::floor((solar_h - middle_h) / 24);
    left[hour] =
        std::max(0.0, forcing.global_w_m2 - forcing.diffuse_w_m2) / std::sqrt(std::max(since_h, kShortestH));
    sum += left[hour];
  }
  SunMemory memory{};
  for (std::size_t hour = 0; hour < left.size(); ++hour)
    memory[hour] = sum > 0 ? static_cast<float>(left[hour] / sum) : 0.0F;
  return memory;
}

float sunlit_share(const SunMemory& memory, std::uint32_t hours) noexcept {
  float share = 0;
  for (std::size_t hour = 0; hour < memory.size(); ++hour) {
    if ((hours >> hour & 1U) != 0) share += memory[hour];
  }
  return share;
}

}  // namespace thermal
