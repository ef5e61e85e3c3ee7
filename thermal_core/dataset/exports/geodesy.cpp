#include "dataset/exports/geodesy.h"

#include <cmath>
#include <numbers>

namespace thermal {
namespace {

// NIMA TR8350.2, "Department of Defense World Geodetic System 1984", third edition (2000), table 3.1.
constexpr double kSemiMajorM = 6'378'137;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);

double radians_of(double angle_deg) { return angle_deg * std::numbers::pi / 180; }
double degrees_of(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

double dot(const LocalVector& a, const LocalVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

LocalVector along(const std::array<LocalVector, 3>& axes, const LocalVector& steps) {
  LocalVector sum{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[k] += axes[axis][k] * steps[axis];
  return sum;
}

/// East, north and up at a position, in Earth-centred axes.
std::array<LocalVector, 3> axes_at(const GeoPosition& geo_position) {
  const double latitude = radians_of(geo_position.latitude_deg);
  const double longitude = radians_of(geo_position.longitude_deg);
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  return {{{-sin_lon, cos_lon, 0},
           {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat},
           {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat}}};
}

/// Radius of curvature in the prime vertical [m] (TR8350.2, section 3.2).
double across_m(double sin_latitude) {
  return kSemiMajorM / std::sqrt(1 - kEccentricity2 * sin_latitude * sin_latitude);
}

/// Earth-centred coordinates [m] (TR8350.2, equation 4-14).
LocalVector earth_centred_m(const GeoPosition& geo_position) {
  const LocalVector up = axes_at(geo_position)[2];
  const double radius_m = across_m(up[2]);
  return {(radius_m + geo_position.height_m) * up[0], (radius_m + geo_position.height_m) * up[1],
          (radius_m * (1 - kEccentricity2) + geo_position.height_m) * up[2]};
}

GeoPosition geodetic(const LocalVector& earth_m) {
  constexpr double kSecond2 = kEccentricity2 / (1 - kEccentricity2);  // second eccentricity, squared
  constexpr double kSemiMinorM = kSemiMajorM * (1 - kFlattening);
  const double from_axis_m = std::hypot(earth_m[0], earth_m[1]);
  double reduced = std::atan2(earth_m[2], from_axis_m * (1 - kFlattening));
  double latitude = 0;
  for (int round = 0; round < 2; ++round) {
    latitude = std::atan2(earth_m[2] + kSecond2 * kSemiMinorM * std::pow(std::sin(reduced), 3),
                          from_axis_m - kEccentricity2 * kSemiMajorM * std::pow(std::cos(reduced), 3));
    reduced = std::atan2((1 - kFlattening) * std::sin(latitude), std::cos(latitude));
  }
  const double sine = std::sin(latitude);
  // Stable at all latitudes: height along the normal of the ellipsoid.
  const double height_m =
      from_axis_m * std::cos(latitude) + earth_m[2] * sine - kSemiMajorM * kSemiMajorM / across_m(sine);
  return {.latitude_deg = degrees_of(latitude),
          .longitude_deg = degrees_of(std::atan2(earth_m[1], earth_m[0])),
          .height_m = height_m};
}

}  // namespace

Georeference::Georeference(const GeoPosition& origin)
    : origin_(origin), axes_(axes_at(origin)), earth_m_(earth_centred_m(origin)) {}

GeoPosition Georeference::position_of(const LocalVector& point_m) const {
  LocalVector earth_m = along(axes_, point_m);
  for (std::size_t k = 0; k < 3; ++k) earth_m[k] += earth_m_[k];
  return geodetic(earth_m);
}

LocalVector Georeference::point_at(const GeoPosition& position) const {
  LocalVector from_origin_m = earth_centred_m(position);
  for (std::size_t k = 0; k < 3; ++k) from_origin_m[k] -= earth_m_[k];
  return {dot(axes_[0], from_origin_m), dot(axes_[1], from_origin_m), dot(axes_[2], from_origin_m)};
}

LocalVector Georeference::direction_at(const GeoPosition& geo_position, const LocalVector& direction) const {
  const LocalVector earth = along(axes_, direction);
  const std::array<LocalVector, 3> there = axes_at(geo_position);
  return {dot(there[0], earth), dot(there[1], earth), dot(there[2], earth)};
}

CameraAttitude attitude_of(const LocalVector& right, const LocalVector& down,
                           const LocalVector& forward) noexcept {
  constexpr double kLevel = 1e-9;  // [rad]: nearer to the horizon, yaw and roll are degenerate
  const LocalVector front = {-down[0], -down[1], -down[2]};
  const double level = std::hypot(front[0], front[1]);
  const double pitch = std::atan2(front[2], level);
  const bool at_horizon = level < kLevel;
  const double yaw = at_horizon ? std::atan2(-right[1], right[0]) : std::atan2(front[0], front[1]);
  const double roll = at_horizon ? 0 : std::atan2(-right[2], -forward[2]);
  const double yaw_deg = degrees_of(yaw);
  return {.yaw_deg = yaw_deg < 0 ? yaw_deg + 360 : yaw_deg,
          .pitch_deg = degrees_of(pitch),
          .roll_deg = degrees_of(roll)};
}

}  // namespace thermal
