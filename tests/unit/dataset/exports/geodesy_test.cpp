#include "dataset/exports/geodesy.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "dataset/exports/tiff.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace geodesy_test {

using namespace thermal;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kPerDegree = std::numbers::pi / 180;

/// Earth-centred coordinates [m] of a place, by the closed form, which is the exact way (TR8350.2, equation 4-14).
LocalVector earth_m(const GeoPosition& place) {
  constexpr double kFlattening = 1 / 298.257223563;
  constexpr double kSquared = kFlattening * (2 - kFlattening);
  const double lat = place.latitude_deg * kPerDegree;
  const double lon = place.longitude_deg * kPerDegree;
  const double normal_m = 6378137.0 / std::sqrt(1 - kSquared * std::pow(std::sin(lat), 2));
  return {(normal_m + place.height_m) * std::cos(lat) * std::cos(lon),
          (normal_m + place.height_m) * std::cos(lat) * std::sin(lon),
          (normal_m * (1 - kSquared) + place.height_m) * std::sin(lat)};
}

double distance_m(const LocalVector& a, const LocalVector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The axes of a camera with these angles: a body's front, right and down in north, east, down, turned by yaw, pitch and
/// roll (ISO 1151-2), as east, north, up. Returns right, down and forward of the camera.
std::array<LocalVector, 3> camera_axes(const CameraAttitude& at) {
  const double cy = std::cos(at.yaw_deg * kPerDegree), sy = std::sin(at.yaw_deg * kPerDegree);
  const double cp = std::cos(at.pitch_deg * kPerDegree), sp = std::sin(at.pitch_deg * kPerDegree);
  const double cr = std::cos(at.roll_deg * kPerDegree), sr = std::sin(at.roll_deg * kPerDegree);
  const LocalVector front = {cp * sy, cp * cy, sp};
  const LocalVector right = {sy * sp * sr + cy * cr, cy * sp * sr - sy * cr, -cp * sr};
  const LocalVector down = {sy * sp * cr - cy * sr, cy * sp * cr + sy * sr, -cp * cr};
  return {right, {-front[0], -front[1], -front[2]}, down};
}

}  // namespace

TEST_CASE("A place at the origin is the origin") {
  for (const GeoPosition& origin :
       {GeoPosition{-19, 23, 900}, GeoPosition{0, 180, -400}, GeoPosition{89, -70, 9000}}) {
    const GeoPosition at = Georeference(origin).position_of({0, 0, 0});
    CHECK_THAT(at.latitude_deg, WithinAbs(origin.latitude_deg, 1e-12));
    CHECK_THAT(at.longitude_deg, WithinAbs(origin.longitude_deg, 1e-12));
    CHECK_THAT(at.height_m, WithinAbs(origin.height_m, 1e-8));
  }
}

TEST_CASE("Places are where the tangent plane has them, to a micrometre up to 100 km away") {
  for (const GeoPosition& origin :
       {GeoPosition{-19, 23, 900}, GeoPosition{0, 179.9, 0}, GeoPosition{88.9, -70, 0}}) {
    const Georeference place(origin);
    for (const LocalVector& point_m :
         {LocalVector{500, -700, 61}, LocalVector{-1e5, 1e5, 1e4}, LocalVector{1e5, 0, -1e3}}) {
      const LocalVector there_m = earth_m(place.position_of(point_m));
      // The plane's axes, from places a little east, north and up; their error is 1e-7 of a length.
      CHECK_THAT(distance_m(there_m, earth_m(origin)),
                 WithinAbs(std::hypot(point_m[0], point_m[1], point_m[2]), 2e-6));
      const LocalVector up = {
          std::cos(origin.latitude_deg * kPerDegree) * std::cos(origin.longitude_deg * kPerDegree),
          std::cos(origin.latitude_deg * kPerDegree) * std::sin(origin.longitude_deg * kPerDegree),
          std::sin(origin.latitude_deg * kPerDegree)};
      const LocalVector from_m = earth_m(origin);
      double rise_m = 0;
      for (std::size_t k = 0; k < 3; ++k) rise_m += up[k] * (there_m[k] - from_m[k]);
      CHECK_THAT(rise_m, WithinAbs(point_m[2], 2e-6));
      const double east_m = -std::sin(origin.longitude_deg * kPerDegree) * (there_m[0] - from_m[0]) +
                            std::cos(origin.longitude_deg * kPerDegree) * (there_m[1] - from_m[1]);
      CHECK_THAT(east_m, WithinAbs(point_m[0], 2e-6));
    }
  }
}

TEST_CASE("The point of a position is the one that has it, to a micrometre") {
  for (const GeoPosition& origin :
       {GeoPosition{-19, 23, 900}, GeoPosition{0, 179.9, 0}, GeoPosition{88.9, -70, 0}}) {
    const Georeference place(origin);
    for (const LocalVector& point_m :
         {LocalVector{0, 0, 0}, LocalVector{500, -700, 61}, LocalVector{-1e5, 1e5, 1e4}})
      CHECK_THAT(distance_m(place.point_at(place.position_of(point_m)), point_m), WithinAbs(0, 1e-6));
  }
}

TEST_CASE("Directions turn with the place: north by the convergence of meridians") {
  const Georeference place({.latitude_deg = -19, .longitude_deg = 23, .height_m = 0});
  const GeoPosition east = place.position_of({10'000, 0, 0});
  const LocalVector north = place.direction_at(east, {0, 1, 0});
  // Meridians meet at the pole: north there is aside by d tan(latitude) / N, here 10 km tan(-19 deg) / 6380 km, and
  // d^2 / N^2 of that.
  CHECK_THAT(north[0], WithinAbs(10'000 * std::tan(-19 * kPerDegree) / 6'380'400, 2e-9));
}

TEST_CASE("The attitude of a camera is that which made its axes") {
  for (const double yaw_deg : {0.0, 45.0, 180.0, 271.5})
    for (const double pitch_deg : {0.0, 7.0, 45.0, 89.0, -20.0})
      for (const double roll_deg : {0.0, 3.0, -100.0}) {
        const auto axes = camera_axes({.yaw_deg = yaw_deg, .pitch_deg = pitch_deg, .roll_deg = roll_deg});
        const CameraAttitude found = attitude_of(axes[0], axes[1], axes[2]);
        CHECK_THAT(std::remainder(found.yaw_deg - yaw_deg, 360), WithinAbs(0, 1e-9));
        CHECK_THAT(found.pitch_deg, WithinAbs(pitch_deg, 1e-9));
        CHECK_THAT(found.roll_deg, WithinAbs(roll_deg, 1e-9));
      }
}

TEST_CASE("A camera at the horizon has the yaw of its view and no roll") {
  // It looks east: right is south, down is down.
  const CameraAttitude found = attitude_of({0, -1, 0}, {0, 0, -1}, {1, 0, 0});
  CHECK_THAT(found.yaw_deg, WithinAbs(90, 1e-9));
  CHECK_THAT(found.pitch_deg, WithinAbs(90, 1e-9));
  CHECK(found.roll_deg == 0);
}

TEST_CASE("An origin is two or three numbers within their limits") {
  const GeoPosition two = parse_origin("-19.25,23.5", 900);
  CHECK(two.latitude_deg == -19.25);
  CHECK(two.longitude_deg == 23.5);
  CHECK(two.height_m == 900);
  CHECK(parse_origin("0,-180,12.5", 900).height_m == 12.5);
  for (const char* text :
       {"", "1", "1,2,3,4", "1,x", "89.1,0", "0,181", "0,0,9001", "nan,0", "0,inf", "1,2,"})
    CHECK(message_of<ConfigError>([&] { (void)parse_origin(text, 0); }) ==
          std::string("--origin = ") + text +
              "; expected LAT,LON or LAT,LON,HEIGHT: -89 to 89 deg, -180 to 180 deg, -500 to 9000 m, e.g. "
              "-19.3,23.1");
}

}  // namespace geodesy_test
