#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/heat/heat_cases.h"
#include "heat/weather/humid_air.h"
#include "support/catch.h"

namespace stability_test {

using namespace thermal;

namespace {

/// One column of extremes.
struct Case {
  DayWeather weather;
  GroundProperties ground;
  HeatSteps steps;
};

/// The parts of a case in which cases differ.
struct Extremes {
  int per_day;
  double latitude_deg;
  int day_of_year;
  double wind_m_s;
  double humidity;
  double cloud;
  double first_m;
  double thickness_m;
  double conductivity;
  bool even_air;
};

Case make(const Extremes& extremes) {
  Case one;
  one.weather.sun = {.latitude_deg = extremes.latitude_deg, .day_of_year = extremes.day_of_year};
  if (extremes.even_air) one.weather.air_max_k = one.weather.air_min_k;
  one.weather.vapour_hpa = extremes.humidity * saturation_hpa(one.weather.air_min_k);
  one.weather.night_wind_m_s = one.weather.day_wind_m_s = extremes.wind_m_s;
  one.weather.cloud_fraction = extremes.cloud;
  one.ground.conductivity_w_m_k = extremes.conductivity;
  one.ground.thickness_m = extremes.thickness_m;
  one.ground.surface.evaporation = extremes.humidity;
  one.steps.per_day = extremes.per_day;
  one.steps.layers.first_m = extremes.first_m;
  one.steps.most_days = 100;
  return one;
}

/// Changes of direction from step to step while the sun is down, of more than `slack_k` before and after.
struct Reversals {
  int all = 0;
  int in_a_row = 0;  ///< right after another one
};
template <typename At>
Reversals reversals(const std::vector<Forcing>& forcing, double slack_k, const At& at_k) {
  Reversals count;
  bool last = false;
  for (std::size_t i = 2; i < forcing.size(); ++i) {
    const bool dark = forcing[i].sun[2] <= 0 && forcing[i - 2].sun[2] <= 0;
    const double before = at_k(i - 1) - at_k(i - 2);
    const double after = at_k(i) - at_k(i - 1);
    const bool here =
        dark && std::min(std::abs(before), std::abs(after)) > slack_k && (before > 0) != (after > 0);
    count.all += here ? 1 : 0;
    count.in_a_row += here && last ? 1 : 0;
    last = here;
  }
  return count;
}

/// Temperature by which the residual of a balance may move a surface, on both sides of a difference: 1e-6 + 1e-9 of
/// the fluxes and of what the body takes up and gives back, over the radiation's 3 W m^-2 K^-1.
double slack_k(const Case& one) {
  const double first_m = std::min(one.steps.layers.first_m, one.ground.thickness_m);
  return 2 * (1e-6 + 1e-9 * (1500 + 2 * one.ground.conductivity_w_m_k / first_m * 330)) / 3;
}

/// The largest slope of what the surface gets from above.
double steepest_w_m2_k(const Case& one, const std::vector<Forcing>& forcing, const SurfaceDay& day) {
  double steepest = 0;
  for (std::size_t i = 0; i < forcing.size(); ++i) {
    const auto flux = [&](double at_k) {
      return SurfaceBalance(one.ground.surface).flux(forcing[i], {}, at_k).flux_w_m2;
    };
    steepest = std::max(steepest, flux(day.surface_k[i] - 0.5) - flux(day.surface_k[i] + 0.5));
  }
  return steepest;
}

/// No surface is colder than the coldest air or, as a blackbody, the sky: vapour adds heat or is the air's own.
double coldest_k(const std::vector<Forcing>& forcing) {
  double coldest = 1000;
  for (const Forcing& moment : forcing)
    coldest = std::min({coldest, moment.air_k, std::pow(moment.sky_w_m2 / kStefanBoltzmann, 0.25)});
  return coldest;
}

void check(const Extremes& extremes) {
  const Case one = make(extremes);
  one.weather.validate();
  one.ground.validate("ground");
  const auto forcing = forcing_of_day(one.weather, one.steps.per_day);
  const SurfaceDay day = day_of_ground(one.ground, {}, {forcing}, one.steps);
  const double slack = slack_k(one);
  INFO(extremes.per_day << " steps, " << extremes.latitude_deg << " deg, day " << extremes.day_of_year
                        << ", wind " << extremes.wind_m_s << " m/s, humidity " << extremes.humidity
                        << ", cloud " << extremes.cloud << ", layers from " << extremes.first_m << " m, "
                        << extremes.thickness_m << " m of " << extremes.conductivity << " W/(m K), even air "
                        << extremes.even_air << ", " << day.days << " days");
  REQUIRE(std::ranges::all_of(day.surface_k, [](double at_k) { return std::isfinite(at_k); }));
  CHECK(std::ranges::min(day.surface_k) >= coldest_k(forcing) - slack);
  CHECK(std::ranges::max(day.surface_k) < 400);
  // Settled, and closed: a mean flux is what the surface lacks of its periodic temperature times its slope, where it
  // lacks at most the last change; or a body that moves with its surface, by the last change, stores it.
  CHECK(day.unsettled_k <= one.steps.settled_k);
  const double steepest = steepest_w_m2_k(one, forcing, day);
  const double stored_w_m2_k = one.ground.heat_capacity_j_m3_k * one.ground.thickness_m / 86400;
  CHECK(std::abs(day.closure_w_m2) <= (one.steps.settled_k + slack) * (steepest + stored_w_m2_k));
  // At night the surface turns no more often than the air, but for one minimum of its own, and never from step to
  // step.
  const Reversals surface = reversals(forcing, slack, [&](std::size_t i) { return day.surface_k[i]; });
  const Reversals air = reversals(forcing, 0, [&](std::size_t i) { return forcing[i].air_k; });
  CHECK(surface.in_a_row == 0);
  CHECK(surface.all <= air.all + 1);
}

/// Thick layers that hardly conduct, at which settling stops too early: the last case of this file.
bool hardly_coupled(double first_m, double thickness_m, double conductivity) {
  return first_m >= 1 && thickness_m >= 0.3 && conductivity <= 0.05;
}

template <typename Use>
void for_each_body(const Use& use) {
  for (const double first_m : {0.001, 0.05, 1.0}) {
    for (const double thickness_m : {0.01, 0.3, 5.0}) {
      for (const double conductivity : {0.05, 1.0, 60.0}) {
        if (!hardly_coupled(first_m, thickness_m, conductivity)) use(first_m, thickness_m, conductivity);
      }
    }
  }
}

template <typename Use>
void for_each_place(const Use& use) {
  for (const double latitude_deg : {-90.0, -66.6, 0.0, 45.0, 90.0}) {
    for (const int day_of_year : {172, 355}) {
      for (const bool even_air : {false, true}) use(latitude_deg, day_of_year, even_air);
    }
  }
}

}  // namespace

TEST_CASE("Days of 24 steps are finite, settled, closed and without oscillation at all extremes") {
  for_each_place([](double latitude_deg, int day_of_year, bool even_air) {
    for_each_body([&](double first_m, double thickness_m, double conductivity) {
      for (const double wind_m_s : {0.0, 3.0}) {
        for (const double humidity : {0.0, 1.0}) {
          for (const double cloud : {0.0, 0.5, 1.0})
            check({24, latitude_deg, day_of_year, wind_m_s, humidity, cloud, first_m, thickness_m,
                   conductivity, even_air});
        }
      }
    });
  });
}

TEST_CASE("So are days of 288 steps") {
  for_each_place([](double latitude_deg, int day_of_year, bool even_air) {
    for_each_body([&](double first_m, double thickness_m, double conductivity) {
      for (const double humidity : {0.0, 1.0})
        check({288, latitude_deg, day_of_year, 0, humidity, humidity / 2, first_m, thickness_m, conductivity,
               even_air});
    });
  });
}

TEST_CASE("So are days of 8640 steps") {
  for (const double latitude_deg : {-66.6, 0.0}) {
    for (const double first_m : {0.001, 1.0}) {
      for (const double thickness_m : {0.01, 5.0}) {
        for (const double conductivity : {1.0, 60.0})
          check({8640, latitude_deg, 172, 0, 1, 0, first_m, thickness_m, conductivity, false});
      }
    }
  }
}

TEST_CASE("Weather at the limits of its domain leaves every body finite") {
  for (const double air_k : {200.0, 340.0}) {
    for (const double wind_m_s : {0.0, 60.0}) {
      for (const double humidity : {0.0, 1.0}) {
        for (const double elevation_m : {-500.0, 9000.0}) {
          DayWeather weather;
          weather.elevation_m = elevation_m;
          weather.air_min_k = weather.air_max_k = air_k;
          weather.vapour_hpa = humidity * saturation_hpa(air_k);
          weather.night_wind_m_s = weather.day_wind_m_s = wind_m_s;
          weather.validate();
          CAPTURE(air_k, wind_m_s, humidity, elevation_m);
          HeatSteps steps;
          steps.per_day = 48;
          const auto forcing = forcing_of_day(weather, steps.per_day);
          GroundProperties ground;
          ground.surface.evaporation = humidity;
          CanopyProperties leaves;
          leaves.leaf_conductance_m_s = 0.05 * humidity;
          SlabProperties slab;
          slab.heat_capacity_j_m2_k = 100;
          const CanopyDay canopy = day_of_canopy(leaves, ground, {}, {forcing}, steps);
          for (const SurfaceDay& day :
               {day_of_ground(ground, {}, {forcing}, steps), day_of_slab(slab, {}, {forcing}, steps),
                canopy.leaves, canopy.ground}) {
            CHECK(std::ranges::all_of(day.surface_k, [](double at_k) { return at_k > 150 && at_k < 450; }));
            CHECK(std::isfinite(day.closure_w_m2));
            CHECK(day.unsettled_k <= steps.settled_k);
          }
        }
      }
    }
  }
}

TEST_CASE("Leaves and their ground are finite, settled and closed in any wind") {
  for (const double wind_m_s : {0.0, 0.3, 2.0, 20.0}) {
    for (const double humidity : {0.0, 1.0}) {
      DayWeather weather;
      weather.night_wind_m_s = weather.day_wind_m_s = wind_m_s;
      weather.vapour_hpa = humidity * saturation_hpa(weather.air_min_k);
      HeatSteps steps;
      steps.per_day = 48;
      const auto forcing = forcing_of_day(weather, steps.per_day);
      for (const double leaf_area_index : {0.05, 1.0, 10.0}) {
        for (const double height_m : {0.005, 0.09, 0.1, 50.0}) {
          for (const double leaf_width_m : {0.0005, 1.0}) {
            for (const double conductance_m_s : {0.0, 1.0 / 80}) {
              for (const double capacity : {10.0, 1e5}) {
                CAPTURE(wind_m_s, humidity, leaf_area_index, height_m, leaf_width_m, conductance_m_s,
                        capacity);
                const CanopyProperties canopy = {.leaf_area_index = leaf_area_index,
                                                 .leaf_width_m = leaf_width_m,
                                                 .height_m = height_m,
                                                 .leaf_conductance_m_s = conductance_m_s,
                                                 .heat_capacity_j_m2_k = capacity};
                const CanopyDay day = day_of_canopy(canopy, heat_cases::dry_soil(), {}, {forcing}, steps);
                CHECK(day.leaves.unsettled_k <= steps.settled_k);
                // Ground and leaves that move by the last change store no more than 1.28e6 * 1.4 + 1e5 * 10 J m^-2 K^-1
                // of it in a day; their surfaces give it to the air by up to 200 W m^-2 K^-1.
                CHECK(std::abs(day.leaves.closure_w_m2) <= steps.settled_k * (2.8e6 / 86400 + 200));
                for (const SurfaceDay& part : {day.leaves, day.ground})
                  CHECK(std::ranges::all_of(part.surface_k,
                                            [](double at_k) { return at_k > 240 && at_k < 350; }));
              }
            }
          }
        }
      }
    }
  }
}

TEST_CASE("Green grass settles on a calm day") {
  // Where the air is unstable, Newton's steps with the exchange of the last one grow: only a bracket finds the balance.
  for (const DayWeather& weather : {heat_cases::winter(), heat_cases::summer()}) {
    DayWeather calm = weather;
    calm.night_wind_m_s = calm.day_wind_m_s = 0;
    const HeatSteps steps;
    const auto forcing = forcing_of_day(calm, steps.per_day);
    const CanopyDay day =
        day_of_canopy(heat_cases::green_grass(), heat_cases::moist_soil(), {}, {forcing}, steps);
    CHECK(day.leaves.unsettled_k <= steps.settled_k);
  }
}

TEST_CASE("A body that hardly exchanges heat with its surface is not taken as settled before it is") {
  // Its surface is the same on the first two days, because little heat comes from below on either: only the heat that
  // stays in it shows that it is not settled.
  const Case one = make({288, 0, 172, 3, 0, 1, 1, 5, 0.05, false});
  const auto forcing = forcing_of_day(one.weather, one.steps.per_day);
  const SurfaceDay day = day_of_ground(one.ground, {}, {forcing}, one.steps);
  CHECK(std::abs(day.closure_w_m2) <= one.steps.settled_k * steepest_w_m2_k(one, forcing, day));
}

TEST_CASE("Water of 10 m settles within the days that are computed") {
  // Its time constant is months: days alone would not do.
  SlabProperties lake;
  lake.heat_capacity_j_m2_k *= 10;
  const auto forcing = forcing_of_day(heat_cases::winter(), 288);
  const HeatSteps steps;
  const SurfaceDay day = day_of_slab(lake, {}, {forcing}, steps);
  CHECK(day.unsettled_k <= steps.settled_k);
}

}  // namespace stability_test
