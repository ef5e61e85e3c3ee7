#include "heat/surface/heat_of_day.h"

#include <cmath>
#include <numbers>

#include "accuracy/heat/heat_cases.h"
#include "base/parallel.h"
#include "heat/weather/forcing.h"
#include "support/catch.h"

namespace heat_of_day_test {

using namespace thermal;

namespace {

std::map<std::string, MaterialHeat> materials() {
  const GroundProperties dry = heat_cases::dry_soil();
  const GroundProperties wet = heat_cases::wet_soil();
  const GroundProperties stone = heat_cases::rock();
  return {{"soil", GroundHeat{.states = {dry, between(dry, wet, 0.5), wet}}},
          {"rock", GroundHeat{.states = {stone, stone, stone}, .is_body = true}},
          {"water", SlabHeat{}}};
}

constexpr HeatSteps kCoarse = {.per_day = 72};

}  // namespace

TEST_CASE("At its nodes, a table has the temperatures of the columns it is made of") {
  const DayWeather weather = heat_cases::winter();
  const HeatOfDay day(weather, materials(), kCoarse);
  const auto forcing = forcing_of_day(weather, kCoarse.per_day);
  const auto all = materials();
  const auto& soil = std::get<GroundHeat>(all.at("soil"));
  for (const double sky_view : {0.1, 0.4, 1.0}) {
    for (const double sunlit : {0.0, 1.0}) {
      for (const double moisture : {0.0, 0.25, 1.0}) {
        const SurfaceExposure exposure = {.sky_view = sky_view, .sunlit = sunlit, .moisture = moisture};
        const SurfaceDay column = day_of(soil, soil, exposure, {.forcing = forcing}, kCoarse);
        for (const double hour : {3.0, 13.5}) {
          CAPTURE(sky_view, sunlit, moisture, hour);
          // Both settle to this, from different starts.
          CHECK_THAT(day.at(hour, {"soil"}).materials.at("soil").temperature_k(exposure),
                     WithinAbs(column.at_k(hour), kCoarse.settled_k));
        }
      }
    }
  }
}

TEST_CASE(
    "Shallow water is colder than deep water at night and warmer by day, and the material's is a metre "
    "deep") {
  const DayWeather weather = heat_cases::winter();
  const HeatOfDay day(weather, materials(), kCoarse);
  const auto forcing = forcing_of_day(weather, kCoarse.per_day);
  const SurfaceDay metre = day_of_slab({}, {}, {.forcing = forcing}, kCoarse);
  const auto at_k = [&](double hour, double depth_m) {
    return day.at(hour, {"water"}).materials.at("water").temperature_k({.depth_m = depth_m});
  };
  for (const double hour : {4.0, 15.0})
    CHECK_THAT(at_k(hour, 1), WithinAbs(metre.at_k(hour), kCoarse.settled_k));
  // What 0.1 m of water and its bed give off in a night, 100 to 250 W m^-2 for 12 h, cools them by 6 to 16 K without what
  // comes back, a metre by a sixth or seventh of that.
  CHECK(at_k(4, 0.1) < at_k(4, 1) - 2);
  CHECK(at_k(15, 0.1) > at_k(15, 1) + 2);
  for (const double hour : {4.0, 15.0}) {
    const double sign = hour < 12 ? 1 : -1;
    for (const double depth_m : {0.0, 0.1, 0.3, 0.8, 1.5})
      CHECK(sign * at_k(hour, depth_m) < sign * at_k(hour, depth_m + 0.2));
  }
}

TEST_CASE(
    "Values beyond the nodes count as the nearest node's, and a surface is level where it is not said") {
  const HeatOfMoment moment = HeatOfDay(heat_cases::winter(), materials(), kCoarse).at(3, {"soil"});
  const MaterialMoment& soil = moment.materials.at("soil");
  CHECK(soil.temperature_k({.sky_view = 2, .sunlit = 3, .moisture = 5}) ==
        soil.temperature_k({.sky_view = 1, .sunlit = 1, .moisture = 1}));
  CHECK(soil.temperature_k({.sky_view = -1, .sunlit = -1, .moisture = -1}) ==
        soil.temperature_k({.sky_view = 0.1, .sunlit = 0, .moisture = 0}));
  CHECK(moment.ground_moisture == moisture_after_rain(heat_cases::winter().rain_days_ago));
}

TEST_CASE("Slopes that faced the sun are warmer, and ground without sky is warmer at night") {
  const HeatOfDay day(heat_cases::winter(), materials(), kCoarse);
  const HeatOfMoment night = day.at(3, {"soil"});
  const MaterialMoment& soil = night.materials.at("soil");
  const double s = std::sin(20 * std::numbers::pi / 180);
  const double c = std::cos(20 * std::numbers::pi / 180);
  // In 19 deg S the sun of July is in the north.
  CHECK(soil.temperature_k({.normal = {0, s, c}}) > soil.temperature_k({.normal = {0, -s, c}}));
  CHECK(soil.temperature_k({.sky_view = 0.4}) > soil.temperature_k({}) + 2);
}

TEST_CASE("Soil cools at night and warms in the morning") {
  const HeatOfDay day(heat_cases::winter(), materials(), kCoarse);
  const auto soil_k = [&](double solar_h) {
    return day.at(solar_h, {"soil"}).materials.at("soil").temperature_k({});
  };
  CHECK(soil_k(3.1) < soil_k(2.9));
  CHECK(soil_k(9.1) > soil_k(8.9) + 0.2);
}

TEST_CASE("Tables are computed when they are first asked for, with the same bits in any order") {
  const HeatOfDay day(heat_cases::winter(), materials(), kCoarse);
  CHECK(day.columns() == 0);
  CHECK(day.at(3).materials.empty());
  CHECK(day.at(3, {"rock", "no such material"}).materials.size() == 1);
  const std::size_t of_rock = day.columns();
  CHECK(of_rock > 0);
  const double later_k = day.at(3, {"rock", "soil"}).materials.at("soil").temperature_k({});
  const HeatOfDay other(heat_cases::winter(), materials(), kCoarse);
  CHECK(other.at(3, {"soil"}).materials.at("soil").temperature_k({}) == later_k);
  CHECK(day.columns() == of_rock + other.columns());
}

TEST_CASE("A table has the same bits on any number of threads") {
  const auto made = [](int threads) {
    return with_threads(threads, [] {
      return HeatOfDay(heat_cases::summer(), materials(), kCoarse)
          .at(4, {"soil"})
          .materials.at("soil")
          .temperature_k({.sky_view = 0.63, .moisture = 0.4});
    });
  };
  CHECK(made(1) == made(2));
}

TEST_CASE("The sun's hours are remembered by the root of the time since, and sum up to all of it") {
  const SunMemory memory = sun_memory(heat_cases::winter(), 20);
  float sum = 0;
  for (const float share : memory) sum += share;
  CHECK_THAT(sum, WithinAbs(1, 1e-6));
  CHECK(memory[3] == 0);
  CHECK(memory[15] > memory[8]);  // as high a sun, seven hours later
  CHECK(sunlit_share(memory, 0) == 0);
  CHECK_THAT(sunlit_share(memory, 0xFFFFFF), WithinAbs(1, 1e-6));
  DayWeather polar = heat_cases::winter();
  polar.sun = {80, 355};
  CHECK(sunlit_share(sun_memory(polar, 12), 0xFFFFFF) == 0);
}

TEST_CASE("What is quadratic in the normal, and what the sun adds, is fitted exactly") {
  for (const bool up : {false, true}) {
    const EastNorthUp sun = up ? EastNorthUp{0.6, 0.48, 0.64} : EastNorthUp{0, 0, 0};
    const auto fit = OrientationFit::of_bodies();
    Orientation truth;
    truth.sun = sun;
    for (std::size_t i = 0; i < Orientation::kTerms; ++i)
      truth.coefficients[i] = 0.3 * static_cast<double>(i) - 1;
    if (!up) truth.coefficients.back() = 0;
    std::vector<double> values;
    for (const EastNorthUp& direction : fit.directions()) values.push_back(truth.at(direction));
    const Orientation fitted = fit.fit(values, sun);
    // The equations are shifted by 1e-9, and the least of their eigenvalues is above 0.05.
    for (std::size_t i = 0; i < Orientation::kTerms; ++i)
      CHECK_THAT(fitted.coefficients[i], WithinAbs(truth.coefficients[i], 5e-8));
  }
  CHECK(OrientationFit::of_level().directions().size() == 1);
  CHECK(OrientationFit::of_ground().directions().size() == 17);
}

TEST_CASE("A sheet in the sun is fitted within 0.6 K in all directions, at any hour of light") {
  GroundProperties sheet;
  sheet.surface = {.albedo = 0.5, .emissivity = 0.93, .roughness_m = 0, .evaporation = 0};
  sheet.conductivity_w_m_k = 50;
  sheet.heat_capacity_j_m3_k = 3.6e6;
  sheet.thickness_m = 0.002;
  const GroundHeat steel = {.states = {sheet, sheet, sheet}, .is_body = true};
  std::map<std::string, MaterialHeat> both = materials();
  both["steel"] = steel;
  const HeatOfDay day(heat_cases::winter(), both, kCoarse);
  const auto forcing = forcing_of_day(day.weather(), kCoarse.per_day);
  const auto& soil = std::get<GroundHeat>(both.at("soil"));
  const SurfaceDay open = day_of(soil, soil, {.moisture = day.at(0).ground_moisture}, {forcing}, kCoarse);
  for (int k = 0; k < 40; ++k) {
    const double z = 1 - (k + 0.5) / 20;
    const double turn = 2.39996 * k;  // even over the sphere
    const double level = std::sqrt(1 - z * z);
    const SurfaceExposure exposure = {.normal = {level * std::sin(turn), level * std::cos(turn), z}};
    const SurfaceDay exact = day_of(steel, soil, exposure, {forcing, open.surface_k}, kCoarse);
    for (const double hour : {8.0, 10.0, 12.0, 14.0, 16.0}) {
      CAPTURE(k, hour);
      CHECK(std::abs(day.at(hour, {"steel"}).materials.at("steel").temperature_k(exposure) -
                     exact.at_k(hour)) < 0.6);
    }
  }
}

}  // namespace heat_of_day_test
