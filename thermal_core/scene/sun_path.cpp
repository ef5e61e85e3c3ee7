#include "scene/sun_path.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace thermal {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double declination_rad(int day_of_year) noexcept {
  const double a = kTurn * (day_of_year - 1) / 365;
  return 0.006918 - 0.399912 * std::cos(a) + 0.070257 * std::sin(a) - 0.006758 * std::cos(2 * a) +
         0.000907 * std::sin(2 * a) - 0.002697 * std::cos(3 * a) + 0.00148 * std::sin(3 * a);
}

}  // namespace

EastNorthUp sun_direction(const SunPath& path, double solar_h) noexcept {
  const double latitude = path.latitude_deg * std::numbers::pi / 180;
  const double declination = declination_rad(path.day_of_year);
  const double hour_angle = kTurn * (solar_h - 12) / 24;
  const double equator = std::cos(declination) * std::cos(hour_angle);  // towards the meridian
  return {-std::cos(declination) * std::sin(hour_angle),
          std::cos(latitude) * std::sin(declination) - std::sin(latitude) * equator,
          std::sin(latitude) * std::sin(declination) + std::cos(latitude) * equator};
}

SunHours sun_hours(const SunPath& path) noexcept {
  SunHours hours;
  for (std::size_t k = 0; k < hours.size(); ++k) hours[k] = sun_direction(path, static_cast<double>(k) + 0.5);
  return hours;
}

}  // namespace thermal
