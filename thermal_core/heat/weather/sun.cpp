#include "heat/weather/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace thermal {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

void SunPath::validate() const {
  require_range("weather.latitude_deg", latitude_deg, "deg", -90, 90);
  require_range("weather.date (day of the year)", day_of_year, "", 1, 366);
}

double declination_rad(int day_of_year) noexcept {
  const double a = kTurn * (day_of_year - 1) / 365;
  return 0.006918 - 0.399912 * std::cos(a) + 0.070257 * std::sin(a) - 0.006758 * std::cos(2 * a) +
         0.000907 * std::sin(2 * a) - 0.002697 * std::cos(3 * a) + 0.00148 * std::sin(3 * a);
}

double sun_nearness(int day_of_year) noexcept { return 1 + 0.033 * std::cos(kTurn * day_of_year / 365); }

double day_length_h(const SunPath& path) noexcept {
  const double cosine = -std::tan(radians(path.latitude_deg)) * std::tan(declination_rad(path.day_of_year));
  return 24 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

EastNorthUp sun_direction(const SunPath& path, double solar_h) noexcept {
  const double latitude = radians(path.latitude_deg);
  const double declination = declination_rad(path.day_of_year);
  const double hour_angle = kTurn * (solar_h - 12) / 24;
  const double equator = std::cos(declination) * std::cos(hour_angle);  // towards the meridian
  return {-std::cos(declination) * std::sin(hour_angle),
          std::cos(latitude) * std::sin(declination) - std::sin(latitude) * equator,
          std::sin(latitude) * std::sin(declination) + std::cos(latitude) * equator};
}

SunHours sun_hours(const SunPath& path) noexcept {
  SunHours hours;
  for (std::size_t hour = 0; hour < hours.size(); ++hour)
    hours[hour] = sun_direction(path, static_cast<double>(hour) + 0.5);
  return hours;
}

}  // namespace thermal
