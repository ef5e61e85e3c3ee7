#include "heat/weather/sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/golden.h"

namespace sun_test {

using namespace thermal;

namespace {

constexpr double kPi = std::numbers::pi;

double radians(double degrees) { return degrees * kPi / 180; }

/// FAO-56, equation 24: one sine, up to 0.026 rad from our series.
double fao_declination_rad(double day) { return 0.409 * std::sin(2 * kPi * day / 365 - 1.39); }

/// FAO-56, equation 25, with the clamps of polar days.
double sunset_angle_rad(double latitude_deg, double declination) {
  return std::acos(std::clamp(-std::tan(radians(latitude_deg)) * std::tan(declination), -1.0, 1.0));
}

/// FAO-56, equation 21 [MJ m^-2 day^-1], for a declination.
double daily_mj_m2(double latitude_deg, double day, double declination) {
  const double sunset = sunset_angle_rad(latitude_deg, declination);
  const double nearness = 1 + 0.033 * std::cos(2 * kPi * day / 365);
  return 24 * 60 / kPi * 0.0820 * nearness *
         (sunset * std::sin(radians(latitude_deg)) * std::sin(declination) +
          std::cos(radians(latitude_deg)) * std::cos(declination) * std::sin(sunset));
}

double fao_mj_m2(double latitude_deg, double day) {
  return daily_mj_m2(latitude_deg, day, fao_declination_rad(day));
}

double fao_day_h(double latitude_deg, double day) {
  return 24 / kPi * sunset_angle_rad(latitude_deg, fao_declination_rad(day));
}

/// What level ground above the air gets in a day [MJ m^-2], from the directions of the sun at the middle of each
/// second.
double sunlight_mj_m2(const SunPath& path) {
  double sum = 0;
  for (int second = 0; second < 86400; ++second)
    sum += std::max(0.0, sun_direction(path, (second + 0.5) / 3600)[2]);
  return kSolarConstantWM2 * sun_nearness(path.day_of_year) * sum / 1e6;
}

double elevation_rad(const SunPath& path, double solar_h) {
  return std::asin(std::clamp(sun_direction(path, solar_h)[2], -1.0, 1.0));
}

/// The days on which the sun crosses the equator within half a day of 0:00, and the solstices.
constexpr int kMarchEquinox = 80;
constexpr int kSeptemberEquinox = 266;
constexpr int kJuneSolstice = 172;
constexpr int kDecemberSolstice = 355;

/// Positions of the sun are sines and cosines of numbers up to 10, added up: some roundings of 1e-16.
constexpr double kRounding = 1e-14;

}  // namespace

TEST_CASE("The distance of the sun is that of FAO-56, example 8") {
  CHECK_THAT(sun_nearness(246), WithinAbs(0.985, 0.0005));  // as printed
  CHECK_THAT(kSolarConstantWM2, WithinAbs(1367, 0.5));      // FAO-56, equation 21: 0.0820 MJ m^-2 min^-1
}

TEST_CASE("Examples 8 and 9 of FAO-56 hold with its declination, and with ours up to their difference") {
  // 3 September, 20 deg S: declination 0.120 rad, sunset at 1.527 rad, 32.2 MJ m^-2 day^-1, 11.7 h, as printed.
  const SunPath path = {.latitude_deg = -20, .day_of_year = 246};
  CHECK_THAT(fao_declination_rad(246), WithinAbs(0.120, 0.0005));
  CHECK_THAT(sunset_angle_rad(-20, fao_declination_rad(246)), WithinAbs(1.527, 0.0005));
  CHECK_THAT(fao_mj_m2(-20, 246), WithinAbs(32.2, 0.05));
  CHECK_THAT(fao_day_h(-20, 246), WithinAbs(11.7, 0.05));
  const double ours = declination_rad(246);
  CHECK_THAT(sunlight_mj_m2(path) - (daily_mj_m2(-20, 246, ours) - fao_mj_m2(-20, 246)),
             WithinAbs(32.2, 0.05));
  CHECK_THAT(day_length_h(path) - (24 / kPi * sunset_angle_rad(-20, ours) - fao_day_h(-20, 246)),
             WithinAbs(11.7, 0.05));
}

TEST_CASE("Daily sunlight is that of FAO-56, table 2.6, and daylight that of table 2.7") {
  const auto rows = read_golden("sun_fao56.csv");
  CHECK(rows.size() == 7 * 12);
  for (const GoldenRow& row : rows) {
    const double latitude_deg = row.numbers[0];
    const SunPath path = {.latitude_deg = latitude_deg, .day_of_year = static_cast<int>(row.numbers[2])};
    CAPTURE(latitude_deg, row.texts[1]);
    const double day = path.day_of_year;
    const double ours = declination_rad(path.day_of_year);
    // Half of the table's last digit; half of a day, because the table does not say how it counts the days of leap
    // years; half of the last digit of 0.0820, which the table may have had more of.
    const double half_day_mj_m2 =
        std::abs(fao_mj_m2(latitude_deg, day + 0.5) - fao_mj_m2(latitude_deg, day - 0.5)) / 2;
    const double from_declination_mj_m2 = daily_mj_m2(latitude_deg, day, ours) - fao_mj_m2(latitude_deg, day);
    CHECK_THAT(sunlight_mj_m2(path) - from_declination_mj_m2,
               WithinAbs(row.numbers[3], 0.05 + half_day_mj_m2 + row.numbers[3] * 0.00005 / 0.0820));
    const double half_day_h =
        std::abs(fao_day_h(latitude_deg, day + 0.5) - fao_day_h(latitude_deg, day - 0.5)) / 2;
    const double from_declination_h =
        24 / kPi * sunset_angle_rad(latitude_deg, ours) - fao_day_h(latitude_deg, day);
    CHECK_THAT(day_length_h(path) - from_declination_h, WithinAbs(row.numbers[4], 0.05 + half_day_h));
    // The bend at sunrise costs the sum over seconds at most 1400 W m^-2 * 7.3e-5 s^-1 / 8 per second and twilight:
    // 2.6e-8 MJ m^-2; adding up 86400 numbers costs less.
    CHECK_THAT(sunlight_mj_m2(path), WithinAbs(daily_mj_m2(latitude_deg, day, ours), 1e-7));
  }
}

TEST_CASE("Declination is within 0.0006 rad of the almanac that its series was fitted to") {
  int compared = 0;
  for (const GoldenRow& row : read_golden("sun_declination.csv")) {
    if (row.texts[0] != "1950") continue;
    CAPTURE(row.texts[2]);
    CHECK_THAT(declination_rad(static_cast<int>(row.numbers[2])), WithinAbs(row.numbers[3], 0.0006));
    ++compared;
  }
  CHECK(compared == 73);
}

TEST_CASE("Declination at noon in 2026 is within 0.008 rad of an almanac") {
  // The series holds for 0:00 in 1950. From there to noon is half a day, and the calendar has gained 76 times 0.0078
  // days on the sun since: 1.1 days in all, of at most 0.0070 rad (23.44 deg times 2 pi / 365.24), beside the 0.0006
  // rad of the series.
  for (const GoldenRow& row : read_golden("sun_declination.csv")) {
    if (row.texts[0] != "2026") continue;
    CAPTURE(row.texts[2]);
    CHECK_THAT(declination_rad(static_cast<int>(row.numbers[2])), WithinAbs(row.numbers[3], 0.0083));
  }
}

TEST_CASE("At an equinox the day has 12 h and the sun rises due east, everywhere but at the poles") {
  for (const int day : {kMarchEquinox, kSeptemberEquinox}) {
    // The sun passes the equator within a day of this one.
    const double declination = declination_rad(day);
    CHECK(std::abs(declination) < 0.0070);
    for (const double latitude_deg : {-80.0, -45.0, -19.0, 0.0, 30.0, 66.5, 85.0}) {
      CAPTURE(day, latitude_deg);
      const SunPath path = {.latitude_deg = latitude_deg, .day_of_year = day};
      // 24 / pi times the arcsine of tan(latitude) tan(declination), which is below 0.08 here.
      const double off = std::abs(std::tan(radians(latitude_deg)) * std::tan(declination));
      CHECK_THAT(day_length_h(path), WithinAbs(12, 24 / kPi * off * 1.01 + kRounding));
      const EastNorthUp rise = sun_direction(path, 12 - day_length_h(path) / 2);
      // North of east by asin(sin(declination) / cos(latitude)).
      CHECK_THAT(rise[1], WithinAbs(0, std::abs(std::sin(declination)) / std::cos(radians(latitude_deg)) +
                                           100 * kRounding));
      CHECK(rise[0] > 0.99);
    }
  }
}

TEST_CASE("At noon the sun is 90 deg - |latitude - declination| high, towards the equator's side") {
  for (int day = 1; day <= 366; day += 5) {
    const double declination = declination_rad(day);
    for (double latitude_deg = -90; latitude_deg <= 90; latitude_deg += 7.5) {
      CAPTURE(day, latitude_deg);
      const SunPath path = {.latitude_deg = latitude_deg, .day_of_year = day};
      const EastNorthUp noon = sun_direction(path, 12);
      // The zenith distance is the difference; its sine points north.
      CHECK_THAT(noon[2], WithinAbs(std::cos(radians(latitude_deg) - declination), kRounding));
      CHECK_THAT(noon[1], WithinAbs(-std::sin(radians(latitude_deg) - declination), kRounding));
      CHECK_THAT(noon[0], WithinAbs(0, kRounding));
      CHECK(elevation_rad(path, 12) >= elevation_rad(path, 11.9) - kRounding);
      CHECK(elevation_rad(path, 12) >= elevation_rad(path, 12.1) - kRounding);
    }
  }
}

TEST_CASE("The sun is on the horizon at sunrise and sunset, in the east before noon and the west after") {
  for (int day = 1; day <= 366; day += 5) {
    for (double latitude_deg = -60; latitude_deg <= 60; latitude_deg += 7.5) {
      CAPTURE(day, latitude_deg);
      const SunPath path = {.latitude_deg = latitude_deg, .day_of_year = day};
      const double half_h = day_length_h(path) / 2;
      CHECK_THAT(sun_direction(path, 12 - half_h)[2], WithinAbs(0, kRounding));
      CHECK_THAT(sun_direction(path, 12 + half_h)[2], WithinAbs(0, kRounding));
      CHECK(sun_direction(path, 9)[0] > 0);
      CHECK(sun_direction(path, 15)[0] < 0);
    }
  }
}

TEST_CASE("Directions have unit length, and repeat every day of 24 h") {
  for (const double latitude_deg : {-90.0, -66.6, -19.0, 0.0, 45.0, 90.0}) {
    for (double hour = -48; hour <= 48; hour += 0.75) {
      const SunPath path = {.latitude_deg = latitude_deg, .day_of_year = 33};
      const EastNorthUp sun = sun_direction(path, hour);
      CHECK_THAT(std::hypot(sun[0], sun[1], sun[2]), WithinAbs(1, kRounding));
      const EastNorthUp next = sun_direction(path, hour + 24);
      for (std::size_t i = 0; i < 3; ++i) CHECK_THAT(next[i], WithinAbs(sun[i], kRounding));
    }
  }
}

TEST_CASE("Beyond the polar circles the sun stays down in winter and up in summer") {
  for (const double latitude_deg : {68.0, 75.0, 90.0}) {
    for (const double side : {1.0, -1.0}) {
      CAPTURE(latitude_deg, side);
      const int summer = side > 0 ? kJuneSolstice : kDecemberSolstice;
      const int winter = side > 0 ? kDecemberSolstice : kJuneSolstice;
      const SunPath light = {.latitude_deg = side * latitude_deg, .day_of_year = summer};
      const SunPath dark = {.latitude_deg = side * latitude_deg, .day_of_year = winter};
      CHECK_THAT(day_length_h(light), WithinAbs(24, kRounding));
      CHECK(day_length_h(dark) == 0);
      for (double hour = 0; hour < 24; hour += 0.25) {
        CHECK(sun_direction(light, hour)[2] > 0);
        CHECK(sun_direction(dark, hour)[2] < 0);
      }
    }
  }
}

TEST_CASE("The polar day begins where latitude and declination make 90 deg") {
  for (const int day : {100, kJuneSolstice, 240}) {
    const double edge_deg = 90 - declination_rad(day) * 180 / kPi;
    CAPTURE(day, edge_deg);
    CHECK(day_length_h({.latitude_deg = edge_deg + 1e-9, .day_of_year = day}) == 24);
    CHECK(day_length_h({.latitude_deg = edge_deg - 0.001, .day_of_year = day}) < 24);
    CHECK(day_length_h({.latitude_deg = -edge_deg - 1e-9, .day_of_year = day}) == 0);
    CHECK(day_length_h({.latitude_deg = -edge_deg + 0.001, .day_of_year = day}) > 0);
  }
}

TEST_CASE("The hemispheres are mirrored: opposite latitude and declination swap north and south") {
  // No two days have exactly opposite declinations, so the mirror is that of the formula: day and night swap instead.
  for (int day = 1; day <= 366; day += 7) {
    for (double latitude_deg = 0; latitude_deg <= 90; latitude_deg += 7.5) {
      CAPTURE(day, latitude_deg);
      const SunPath north = {.latitude_deg = latitude_deg, .day_of_year = day};
      const SunPath south = {.latitude_deg = -latitude_deg, .day_of_year = day};
      CHECK_THAT(day_length_h(north) + day_length_h(south), WithinAbs(24, 24 * kRounding));
      for (const double hour : {0.0, 3.7, 6.0, 12.0, 19.1}) {
        const EastNorthUp here = sun_direction(north, hour);
        const EastNorthUp there = sun_direction(south, hour + 12);  // seen from the antipodes
        CHECK_THAT(there[0], WithinAbs(-here[0], kRounding));
        CHECK_THAT(there[1], WithinAbs(here[1], kRounding));
        CHECK_THAT(there[2], WithinAbs(-here[2], kRounding));
      }
    }
  }
}

TEST_CASE("Seasons are opposite: the longest days of one hemisphere are the shortest of the other") {
  for (const double latitude_deg : {10.0, 45.0, 60.0}) {
    const auto day_h = [](double latitude, int day) {
      return day_length_h({.latitude_deg = latitude, .day_of_year = day});
    };
    for (int day = 1; day <= 366; ++day) {
      CHECK(day_h(latitude_deg, day) <= day_h(latitude_deg, kJuneSolstice) + 0.01);
      CHECK(day_h(-latitude_deg, day) >= day_h(-latitude_deg, kJuneSolstice) - 0.01);
    }
    // Within 0.0006 rad the two solstices are as far from the equator: 24 / pi * tan(lat) / cos(dec)^2 / sin(sunset).
    CHECK_THAT(day_h(latitude_deg, kJuneSolstice),
               WithinAbs(day_h(-latitude_deg, kDecemberSolstice),
                         24 / kPi * 2 * 0.0006 * std::tan(radians(latitude_deg)) / 0.84 /
                             std::sin(sunset_angle_rad(latitude_deg, declination_rad(kJuneSolstice)))));
  }
}

}  // namespace sun_test
