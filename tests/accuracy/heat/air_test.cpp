#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "heat/weather/forcing.h"
#include "heat/weather/humid_air.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace air_test {

using namespace thermal;

namespace {

constexpr double kMinuteH = 1.0 / 60;

/// Sums of numbers near 300: some roundings of 6e-14.
constexpr double kRoundingK = 1e-12;

DayWeather weather_at(double latitude_deg, int day_of_year) {
  DayWeather weather;
  weather.sun = {.latitude_deg = latitude_deg, .day_of_year = day_of_year};
  return weather;
}

double sunrise_h(const DayWeather& weather) { return 12 - day_length_h(weather.sun) / 2; }

}  // namespace

TEST_CASE("Air is coldest at sunrise and warmest 1.86 h after noon") {
  for (const double latitude_deg : {-60.0, -19.0, 0.0, 35.0, 60.0}) {
    for (const int day : {15, 80, 172, 300}) {
      const DayWeather weather = weather_at(latitude_deg, day);
      CAPTURE(latitude_deg, day);
      CHECK_THAT(air_temperature_k(weather, sunrise_h(weather)), WithinAbs(weather.air_min_k, kRoundingK));
      CHECK_THAT(air_temperature_k(weather, 12 + 1.86), WithinAbs(weather.air_max_k, kRoundingK));
      for (double hour = 0; hour < 24; hour += kMinuteH) {
        const double air_k = air_temperature_k(weather, hour);
        CHECK(air_k >= weather.air_min_k - kRoundingK);
        CHECK(air_k <= weather.air_max_k + kRoundingK);
      }
    }
  }
}

TEST_CASE("Air warms from sunrise to its maximum and cools from there to the next sunrise") {
  const DayWeather weather = weather_at(-19, 190);
  for (double after_h = 0; after_h < 24 - kMinuteH; after_h += kMinuteH) {
    const double hour = sunrise_h(weather) + after_h;
    CAPTURE(hour);
    const double change_k = air_temperature_k(weather, hour + kMinuteH) - air_temperature_k(weather, hour);
    if (hour + kMinuteH < 12 + 1.86) CHECK(change_k > 0);
    if (hour > 12 + 1.86) CHECK(change_k < 0);
  }
}

TEST_CASE("Air has no steps: over midnight, at sunrise and at sunset") {
  for (const double latitude_deg : {-65.0, -19.0, 0.0, 45.0, 65.0}) {
    for (const int day : {1, 80, 172, 355}) {
      DayWeather weather = weather_at(latitude_deg, day);
      CAPTURE(latitude_deg, day);
      const double day_h = day_length_h(weather.sun);
      // Slopes: pi / (day + 3.72) by day; at night the decay starts with 2.2 / (1 - exp(-2.2)) < 2.5 per night.
      const double steepest_k_h =
          (weather.air_max_k - weather.air_min_k) * std::max(3.15 / (day_h + 3.72), 2.5 / (24 - day_h));
      for (double hour = 0; hour < 24; hour += kMinuteH) {
        const double change_k =
            air_temperature_k(weather, hour + kMinuteH) - air_temperature_k(weather, hour);
        CHECK(std::abs(change_k) <= steepest_k_h * kMinuteH + kRoundingK);
      }
      for (const double hour : {0.0, sunrise_h(weather), 24 - sunrise_h(weather)}) {
        const double change_k =
            air_temperature_k(weather, hour + 1e-9) - air_temperature_k(weather, hour - 1e-9);
        CHECK(std::abs(change_k) <= steepest_k_h * 2e-9 + kRoundingK);
      }
    }
  }
}

TEST_CASE("Air of every day is the same, for any hour") {
  for (const double latitude_deg : {-19.0, 80.0}) {
    for (const double hour : {-1e-18, 0.0, 5.3, 13.86, 23.999}) {
      const DayWeather weather = weather_at(latitude_deg, 172);
      CAPTURE(latitude_deg, hour);
      for (const double days : {-10.0, -1.0, 1.0, 365.0}) {
        // An hour near 8760 has an error of 1e-12 h, and air changes by at most 25 K/h.
        CHECK_THAT(air_temperature_k(weather, hour + 24 * days),
                   WithinAbs(air_temperature_k(weather, hour), 25 * 1e-11 + kRoundingK));
      }
    }
  }
}

TEST_CASE("Where the sun does not rise or set, air is a cosine that is highest at 14:00") {
  for (const double latitude_deg : {-90.0, -75.0, 75.0, 90.0}) {
    for (const int day : {172, 355}) {
      const DayWeather weather = weather_at(latitude_deg, day);
      CAPTURE(latitude_deg, day);
      CHECK_THAT(air_temperature_k(weather, 14), WithinAbs(weather.air_max_k, kRoundingK));
      CHECK_THAT(air_temperature_k(weather, 2), WithinAbs(weather.air_min_k, kRoundingK));
      const double mean_k = (weather.air_min_k + weather.air_max_k) / 2;
      CHECK_THAT(air_temperature_k(weather, 8), WithinAbs(mean_k, kRoundingK));
      CHECK_THAT(air_temperature_k(weather, 20), WithinAbs(mean_k, kRoundingK));
    }
  }
}

TEST_CASE("With the same minimum and maximum, air stays as it is") {
  for (const double latitude_deg : {-90.0, -66.6, 0.0, 45.0, 90.0}) {
    DayWeather weather = weather_at(latitude_deg, 172);
    weather.air_min_k = weather.air_max_k = 280;
    for (double hour = 0; hour < 24; hour += 0.1) CHECK(air_temperature_k(weather, hour) == 280);
  }
}

TEST_CASE("A table of hours is met at every hour, and straight between") {
  DayWeather weather = weather_at(-19, 190);
  for (int hour = 0; hour < 24; ++hour) weather.air_hourly_k.push_back(280 + (hour * hour) % 17);
  for (int hour = 0; hour < 24; ++hour) {
    CAPTURE(hour);
    const auto at = static_cast<std::size_t>(hour);
    CHECK(air_temperature_k(weather, hour) == weather.air_hourly_k[at]);
    CHECK(air_temperature_k(weather, hour - 24) == weather.air_hourly_k[at]);
    const double next_k = weather.air_hourly_k[(at + 1) % 24];
    CHECK_THAT(air_temperature_k(weather, hour + 0.25),
               WithinAbs(0.75 * weather.air_hourly_k[at] + 0.25 * next_k, kRoundingK));
    // From the left of the hour too; 1e-9 h at up to 17 K/h.
    CHECK_THAT(air_temperature_k(weather, hour - 1e-9),
               WithinAbs(weather.air_hourly_k[at], 1.7e-8 + kRoundingK));
  }
}

TEST_CASE("Clouds by the hour are met at every hour, and let pass what clouds of all day do") {
  DayWeather weather = weather_at(-19, 190);
  DayWeather all_day = weather;
  for (int hour = 0; hour < 24; ++hour) weather.cloud_hourly.push_back((hour * 7 % 11) / 10.0);
  for (int hour = 0; hour < 24; ++hour) {
    CAPTURE(hour);
    const auto at = static_cast<std::size_t>(hour);
    CHECK(cloud_fraction_at(weather, hour) == weather.cloud_hourly[at]);
    const double next = weather.cloud_hourly[(at + 1) % 24];
    CHECK_THAT(cloud_fraction_at(weather, hour + 24.25),
               WithinAbs(0.75 * weather.cloud_hourly[at] + 0.25 * next, 1e-15));
    all_day.cloud_fraction = weather.cloud_hourly[at];
    CHECK(cloud_fraction_at(all_day, hour + 0.7) == all_day.cloud_fraction);
    CHECK(forcing_at(weather, hour).sky_w_m2 == forcing_at(all_day, hour).sky_w_m2);
    CHECK(forcing_at(weather, hour).global_w_m2 == forcing_at(all_day, hour).global_w_m2);
    CHECK(forcing_at(weather, hour).beam_w_m2 == forcing_at(all_day, hour).beam_w_m2);
  }
}

TEST_CASE("Clouds by the hour are 24 shares") {
  DayWeather weather;
  weather.cloud_hourly.assign(23, 0);
  CHECK(message_of<ConfigError>([&] { weather.validate(); }) ==
        "weather.cloud_hourly = 23 numbers; expected 24 numbers, of 0:00 to 23:00");
  weather.cloud_hourly = std::vector<double>(24, 0);
  weather.cloud_hourly[21] = 1.5;
  CHECK(message_of<ConfigError>([&] { weather.validate(); }) ==
        "weather.cloud_hourly[21] = 1.5; expected 0 to 1");
}

TEST_CASE("Wind is that of the night from sunset to sunrise and that of the day at noon") {
  DayWeather weather = weather_at(-19, 190);
  const double rise_h = sunrise_h(weather);
  CHECK(forcing_at(weather, rise_h - 0.01).wind_m_s == weather.night_wind_m_s);
  CHECK(forcing_at(weather, 24 - rise_h + 0.01).wind_m_s == weather.night_wind_m_s);
  CHECK(forcing_at(weather, 0).wind_m_s == weather.night_wind_m_s);
  CHECK_THAT(forcing_at(weather, 12).wind_m_s, WithinAbs(weather.day_wind_m_s, 1e-14));
  CHECK_THAT(forcing_at(weather, rise_h).wind_m_s, WithinAbs(weather.night_wind_m_s, 1e-14));
}

TEST_CASE("Vapour is at most what the air can hold, at any hour") {
  DayWeather weather = weather_at(-19, 190);
  weather.vapour_hpa = saturation_hpa(weather.air_max_k);
  for (double hour = 0; hour < 24; hour += 0.25) {
    const Forcing forcing = forcing_at(weather, hour);
    CHECK(forcing.vapour_hpa == std::min(weather.vapour_hpa, saturation_hpa(forcing.air_k)));
  }
}

TEST_CASE(
    "Sunlight is 0 at night, and by day what the clear sky of FAO-56 lets through, split in beam and sky") {
  for (const double cloud : {0.0, 0.4, 1.0}) {
    DayWeather weather = weather_at(-19, 190);
    weather.cloud_fraction = cloud;
    for (double hour = 0; hour < 24; hour += 0.1) {
      CAPTURE(cloud, hour);
      const Forcing forcing = forcing_at(weather, hour);
      const double sine = std::max(0.0, sun_direction(weather.sun, hour)[2]);
      const double above_w_m2 = kSolarConstantWM2 * sun_nearness(190) * sine;
      CHECK_THAT(forcing.global_w_m2,
                 WithinRel(above_w_m2 * (0.75 + 2e-5 * 900) * (1 - 0.65 * cloud * cloud), 1e-14));
      CHECK_THAT(forcing.beam_w_m2 * sine + forcing.diffuse_w_m2, WithinRel(forcing.global_w_m2, 1e-14));
      CHECK(forcing.beam_w_m2 >= 0);
    }
  }
}

TEST_CASE("A day of forcing holds the ends of its steps, the last of them 24:00") {
  const DayWeather weather = weather_at(-19, 190);
  const std::vector<Forcing> day = forcing_of_day(weather, 96);
  REQUIRE(day.size() == 96);
  for (std::size_t step = 0; step < day.size(); ++step)
    CHECK(day[step].air_k == forcing_at(weather, 0.25 * static_cast<double>(step + 1)).air_k);
  CHECK_THAT(day.back().air_k, WithinAbs(air_temperature_k(weather, 0), kRoundingK));
}

}  // namespace air_test
