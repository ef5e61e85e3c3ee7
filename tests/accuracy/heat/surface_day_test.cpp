#include <algorithm>
#include <cmath>
#include <vector>

#include "accuracy/heat/heat_cases.h"
#include "heat/surface/surface_balance.h"
#include "heat/weather/humid_air.h"
#include "support/catch.h"

namespace surface_day_test {

using namespace thermal;
using namespace heat_cases;

namespace {

constexpr double kDayS = 86400;

double largest_difference_k(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// What a flux into the ground of 1 W m^-2 must be paid with, at least, in what the surface gets from above, over a
/// day of these temperatures: the largest slope of that.
double steepest_w_m2_k(const SurfaceProperties& surface, const std::vector<Forcing>& forcing,
                       const SurfaceDay& day) {
  double steepest = 0;
  for (std::size_t i = 0; i < forcing.size(); ++i) {
    const auto flux = [&](double at_k) {
      return SurfaceBalance(surface).flux(forcing[i], {}, at_k).flux_w_m2;
    };
    steepest = std::max(steepest, (flux(day.surface_k[i] - 0.5) - flux(day.surface_k[i] + 0.5)));
  }
  return steepest;
}

HeatSteps until(double settled_k, int most_days = 400) {
  HeatSteps steps;
  steps.settled_k = settled_k;
  steps.most_days = most_days;
  return steps;
}

/// Unchanging weather at night.
std::vector<Forcing> even_forcing(int steps, double air_k, double sky_w_m2) {
  Forcing forcing;
  forcing.air_k = air_k;
  forcing.wind_m_s = 1;
  forcing.pressure_hpa = 900;
  forcing.sky_w_m2 = sky_w_m2;
  return {static_cast<std::size_t>(steps), forcing};
}

/// Share of even radiation from above that passes leaves, exp(-LAI / (2 sin h)), by summing over the sky.
double passed_by_summing(double leaf_area_index) {
  constexpr int kRings = 40'000;
  double sum = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double sine = (ring + 0.5) / kRings;
    sum += 2 * sine * std::exp(-leaf_area_index / (2 * sine)) / kRings;
  }
  return sum;
}

/// What a layer of leaves gets [W m^-2 of ground], written down anew.
double leaves_gain_w_m2(const CanopyProperties& canopy, double exchanged, const Forcing& forcing,
                        double leaves_k, double ground_k) {
  const double cover = 1 - std::exp(-canopy.leaf_area_index / 2);
  const bool low = canopy.height_m <= 2;
  const double wind = std::max(forcing.wind_m_s, 0.3);
  const double among_m_s = std::max(0.5 * wind, 0.15);
  const double layer_s_m = 100 * std::sqrt(canopy.leaf_width_m / among_m_s) / (2 * canopy.leaf_area_index);
  const double air_heat = 1005 * air_density_kg_m3(forcing.pressure_hpa, forcing.air_k);
  const double air_s_m =
      low ? air_heat / GroundExchange(0.13 * canopy.height_m + 0.01)(forcing, leaves_k) : 12 / wind;
  const double resistance_s_m = layer_s_m + air_s_m;
  const double lacking = 0.622 * (saturation_hpa(leaves_k) - forcing.vapour_hpa) / forcing.pressure_hpa;
  double vapour = 0;
  if (lacking < 0) {
    vapour = lacking / resistance_s_m;
  } else if (canopy.leaf_conductance_m_s > 0 && forcing.global_w_m2 > 0) {
    const double open = std::min(1.0, forcing.global_w_m2 / 200);
    vapour = lacking / (resistance_s_m + 1 / (open * canopy.leaf_conductance_m_s * canopy.leaf_area_index));
  }
  const auto blackbody = [](double at_k) { return kStefanBoltzmann * std::pow(at_k, 4); };
  return cover * (1 - canopy.albedo) * forcing.global_w_m2 +
         exchanged * canopy.emissivity * (forcing.sky_w_m2 + blackbody(ground_k) - 2 * blackbody(leaves_k)) -
         air_heat * (leaves_k - forcing.air_k) / resistance_s_m - air_heat / 1005 * 2.47e6 * vapour;
}

}  // namespace

TEST_CASE("Leaves of all directions let pass what summing over the sky gives") {
  CHECK(diffuse_through_leaves(0) == 1);
  // Midpoints of 40,000 rings are within 1e-9 of a smooth function, and within a ring's share of the sky, 2e-9, of one
  // that is not.
  for (const double area : {1e-6, 0.01, 0.3, 1.0, 2.5, 6.0, 10.0, 30.0})
    CHECK_THAT(diffuse_through_leaves(area), WithinAbs(passed_by_summing(area), 1e-8));
  CHECK_THAT(diffuse_through_leaves(100), WithinAbs(0, 1e-22));
}

TEST_CASE(
    "Air near the ground is between the ground's temperature and that at 2 m, as its exchange demands") {
  constexpr double kRoughnessM = 0.005;
  const GroundExchange exchange(kRoughnessM);
  const double wind_m_s = GENERATE(0.3, 1.0, 2.0, 4.0);
  const double ground_k = GENERATE(268.0, 272.5, 280.0);
  CAPTURE(wind_m_s, ground_k);
  const Forcing forcing = {.air_k = 273, .wind_m_s = wind_m_s, .pressure_hpa = 900};
  CHECK(exchange.air_k(forcing, ground_k, 2) == 273);
  CHECK(exchange.air_k(forcing, ground_k, 5) == 273);
  // Stability bends the profile by what lies above a height, of which the roughness for heat is a 4000th of 2 m.
  CHECK_THAT(exchange.air_k(forcing, ground_k, kRoughnessM / 10), WithinAbs(ground_k, 7.0 / 4000));
  // The heat that passes each height is the same: a slope of the temperature times the diffusivity of air that a stability
  // of 1 + 5 z / L hinders, with the friction that the profile of the wind has.
  const double wind_log = std::log(2 / kRoughnessM);
  const double air_heat = 1005 * air_density_kg_m3(forcing.pressure_hpa, forcing.air_k);
  const double wanted_w_m2 = exchange(forcing, ground_k) * (forcing.air_k - ground_k);
  const auto flux_w_m2 = [&](double per_l) {
    const double friction = 0.4 * wind_m_s / (wind_log + 10 * per_l);
    const double heat_log = std::log(20 / kRoughnessM) + 10 * per_l;
    return air_heat * 0.4 * friction * (forcing.air_k - ground_k) / heat_log;
  };
  if (ground_k > 273 || flux_w_m2(0) < wanted_w_m2) {  // neutral: the profile is that of the logarithm
    const double share = std::log(2 / 0.3) / std::log(20 / kRoughnessM);
    CHECK_THAT(exchange.air_k(forcing, ground_k, 0.3), WithinAbs(273 + share * (ground_k - 273), 1e-9));
    return;
  }
  double low = 0;
  double high = 100;
  for (int i = 0; i < 100; ++i) (flux_w_m2((low + high) / 2) > wanted_w_m2 ? low : high) = (low + high) / 2;
  const double scale_k = wanted_w_m2 / (air_heat * 0.4 * 0.4 * wind_m_s / (wind_log + 10 * low));
  for (const double height_m : {0.05, 0.3, 0.6, 1.5}) {
    const double below_k = scale_k * (std::log(2 / height_m) + 5 * low * (2 - height_m));
    CHECK_THAT(exchange.air_k(forcing, ground_k, height_m), WithinAbs(273 - below_k, 1e-6));
  }
}

TEST_CASE(
    "A shrub that stands alone is near the air that its open ground cools, not colder than that ground") {
  const DayWeather weather = winter();
  const HeatSteps steps;
  const auto forcing = forcing_of_day(weather, steps.per_day);
  const SurfaceDay open = day_of_ground(dry_soil(), {}, {forcing}, steps);
  const CanopyProperties shrub = {.leaf_area_index = 0.9, .leaf_width_m = 0.01, .height_m = 1.2};
  const auto leaves_k = [&](Stand stand) {
    return day_of_canopy(shrub, dry_soil(), {}, {forcing, open.surface_k}, steps, stand).leaves.at_k(3);
  };
  const double layer_k = leaves_k(Stand::cover);
  const double alone_k = leaves_k(Stand::alone);
  const Forcing now = forcing_at(weather, 3);
  const double around_k = GroundExchange(0.03).air_k(now, open.at_k(3), 0.6);
  CHECK(around_k < now.air_k - 0.5);
  // A leaf a centimetre wide takes 20 W m^-2 K^-1 or more from the air, and loses at most 40 W m^-2 to a clear sky.
  CHECK(alone_k < around_k);
  CHECK(alone_k > around_k - 2);
  CHECK(alone_k > open.at_k(3));
  CHECK(alone_k > layer_k + 1);
}

TEST_CASE("Leaves store what they get, at every step of the day") {
  for (const bool wet : {false, true}) {
    const DayWeather weather = wet ? summer() : winter();
    for (const CanopyProperties& canopy : {dry_grass(), green_grass(), dry_crown(), green_crown()}) {
      CAPTURE(wet, canopy.leaf_area_index, canopy.height_m);
      const HeatSteps steps;
      const auto forcing = forcing_of_day(weather, steps.per_day);
      const CanopyDay day = day_of_canopy(canopy, wet ? moist_soil() : dry_soil(), {}, {forcing}, steps);
      const double stored = canopy.heat_capacity_j_m2_k * canopy.leaf_area_index / 300;
      const double exchanged = 1 - passed_by_summing(canopy.leaf_area_index);
      double largest_w_m2 = 0;
      for (std::size_t i = 1; i < forcing.size(); ++i) {
        const double gain =
            leaves_gain_w_m2(canopy, exchanged, forcing[i], day.leaves.surface_k[i], day.ground.surface_k[i]);
        const double kept = stored * (day.leaves.surface_k[i] - day.leaves.surface_k[i - 1]);
        largest_w_m2 = std::max(largest_w_m2, std::abs(gain - kept));
      }
      // The search ends with a step below 1e-6 K; leaves exchange less than 200 W m^-2 K^-1 with everything, and their
      // ground is found as exactly.
      CHECK(largest_w_m2 <= 2e-4);
    }
  }
}

TEST_CASE("Heat that goes into ground by day comes out at night") {
  for (const DayWeather& weather : {winter(), summer()}) {
    for (const GroundProperties& ground :
         {dry_soil(), moist_soil(), wet_soil(), rock(), dry_road(), bark()}) {
      for (const double settled_k : {0.01, 0.0005, 1e-6}) {
        const HeatSteps steps = until(settled_k);
        const auto forcing = forcing_of_day(weather, steps.per_day);
        const SurfaceDay day = day_of_ground(ground, {}, {forcing}, steps);
        CAPTURE(weather.sun.day_of_year, ground.conductivity_w_m_k, settled_k, day.days);
        CHECK(day.unsettled_k <= settled_k);
        // A mean flux is what the surface lacks of its periodic temperature times the slope of what it gets from
        // above. What it lacks is at most the last change, since each day removes more than half of what is left (the
        // next case).
        CHECK(std::abs(day.closure_w_m2) <= settled_k * steepest_w_m2_k(ground.surface, forcing, day) + 1e-6);
      }
    }
  }
}

TEST_CASE("Each day removes more than half of what is left to the periodic day") {
  for (const DayWeather& weather : {winter(), summer()}) {
    for (const GroundProperties& ground : {dry_soil(), moist_soil(), wet_soil(), rock()}) {
      const auto forcing = forcing_of_day(weather, 288);
      const SurfaceDay last = day_of_ground(ground, {}, {forcing}, until(1e-7));
      const SurfaceDay rough = day_of_ground(ground, {}, {forcing}, until(0.05));
      CAPTURE(weather.sun.day_of_year, ground.conductivity_w_m_k, last.days, rough.days);
      // From 0.05 K to 1e-7 K are 19 halvings.
      CHECK(last.days <= rough.days + 19);
      CHECK(largest_difference_k(last.surface_k, rough.surface_k) <= 0.05);
    }
  }
}

TEST_CASE("Heat that goes into water and steel by day comes out at night") {
  SlabProperties water;
  SlabProperties pan;
  pan.heat_capacity_j_m2_k /= 5;
  for (const DayWeather& weather : {winter(), summer()}) {
    for (const SlabProperties& slab : {water, pan, steel_roof()}) {
      for (const double settled_k : {0.01, 0.0005}) {
        const HeatSteps steps = until(settled_k);
        const auto forcing = forcing_of_day(weather, steps.per_day);
        const SurfaceDay day = day_of_slab(slab, {}, {forcing}, steps);
        CAPTURE(weather.sun.day_of_year, slab.heat_capacity_j_m2_k, settled_k, day.days);
        CHECK(day.unsettled_k <= settled_k);
        // The slab's heat is its temperature times its capacity, and that changed by at most settled_k in the day;
        // the bound of the balance's residual, 1e-6, and rounding of 300 K in each step do not count.
        CHECK(std::abs(day.closure_w_m2) <= slab.heat_capacity_j_m2_k * (settled_k + 1e-11) / kDayS + 1e-6);
      }
    }
  }
}

TEST_CASE("Heat that goes into grass, trees and their ground by day comes out at night") {
  for (const bool wet : {false, true}) {
    const DayWeather weather = wet ? summer() : winter();
    for (const CanopyProperties& canopy : {dry_grass(), green_grass(), dry_crown(), green_crown()}) {
      for (const double settled_k : {0.01, 0.0005}) {
        const HeatSteps steps = until(settled_k);
        const auto forcing = forcing_of_day(weather, steps.per_day);
        const GroundProperties ground = wet ? moist_soil() : dry_soil();
        const CanopyDay day = day_of_canopy(canopy, ground, {}, {forcing}, steps);
        CAPTURE(wet, canopy.leaf_area_index, settled_k, day.ground.days);
        CHECK(day.leaves.unsettled_k <= settled_k);
        CHECK(day.ground.unsettled_k <= settled_k);
        CHECK(day.leaves.closure_w_m2 == day.ground.closure_w_m2);
        // As for ground. Leaves hand on less than what ground and leaves would exchange with the air alone.
        const double steepest = steepest_w_m2_k(ground.surface, forcing, day.ground);
        CHECK(std::abs(day.ground.closure_w_m2) <= settled_k * steepest + 1e-6);
      }
    }
  }
}

TEST_CASE("A slab in even weather comes to its steady state by exp(-t / tau)") {
  // A body in the wind, so that its exchange is 5.8 + 2 W m^-2 K^-1 at any temperature; only radiation bends.
  const SlabProperties steel = steel_roof();
  const int per_day = 8640;
  const double step_s = kDayS / per_day;
  const double air_k = 280;
  const double sky_w_m2 = 0.97 * kStefanBoltzmann * std::pow(air_k, 4);
  const auto forcing = even_forcing(per_day, air_k, sky_w_m2);
  const SurfaceDay day = day_of_slab(steel, {}, {forcing}, until(0, 1));
  const double linear = body_exchange(1) + steel.behind_w_m2_k;
  const double radiated = steel.surface.emissivity * kStefanBoltzmann;
  const auto gained = [&](double slab_k) {
    return steel.surface.emissivity * sky_w_m2 - radiated * std::pow(slab_k, 4) - linear * (slab_k - air_k);
  };
  double steady_k = 250;
  for (int round = 0; round < 50; ++round)
    steady_k += gained(steady_k) / (linear + 4 * radiated * std::pow(steady_k, 3));
  CHECK(steady_k < air_k - 0.3);
  // Slopes at both ends bound those between, so the decay lies between those of both, in steps of backward Euler.
  const double weak = linear + 4 * radiated * std::pow(steady_k, 3);
  const double strong = linear + 4 * radiated * std::pow(air_k, 3);
  const double capacity = steel.heat_capacity_j_m2_k;
  for (const int step : {10, 60, 180, 600, 1200}) {  // up to 3.3 h; tau is 0.12 h
    CAPTURE(step);
    const double left = (day.surface_k[static_cast<std::size_t>(step) - 1] - steady_k) / (air_k - steady_k);
    // The balance leaves 1e-6 W m^-2 + 1e-9 of the fluxes, which weighs 1 / weak.
    const double residual = (1e-6 + 1e-9 * (400 + capacity / step_s * air_k)) / weak / (air_k - steady_k);
    CHECK(left <= std::pow(1 + weak * step_s / capacity, -step) + residual);
    CHECK(left >= std::pow(1 + strong * step_s / capacity, -step) - residual);
    // And so exp(-t / tau), up to half of the square of a step's share of tau in each step.
    const double share = strong * step_s / capacity;
    const double exact = std::exp(-weak * step_s * step / capacity);
    CHECK_THAT(left, WithinAbs(exact, exact * step * (share * share / 2 + share - weak * step_s / capacity) +
                                          residual));
  }
}

TEST_CASE("In even weather, ground and slab stay at the temperature where they gain nothing") {
  const double air_k = 280;
  const auto forcing = even_forcing(288, air_k, 250);
  const SurfaceProperties surface = dry_soil().surface;
  const double steady_k =
      SurfaceBalance(surface).balanced_k(forcing.front(), {.longwave_w_m2 = 250}, {}, air_k);
  CHECK(steady_k < air_k - 1);
  const HeatSteps steps = until(1e-7);
  const SurfaceDay ground = day_of_ground(dry_soil(), {}, {forcing}, steps);
  SlabProperties plate = {.surface = surface, .heat_capacity_j_m2_k = 1e4};
  const SurfaceDay slab = day_of_slab(plate, {}, {forcing}, steps);
  const auto gained = [&](double at_k) {
    return SurfaceBalance(surface).flux(forcing.front(), {.longwave_w_m2 = 250}, at_k).flux_w_m2;
  };
  const double slope = (gained(steady_k - 0.01) - gained(steady_k + 0.01)) / 0.02;
  CHECK(slope > 2);
  for (const SurfaceDay& day : {ground, slab}) {
    // What is left after settling, at most as much as the last change; and the residual of 1e-9 of what is taken up
    // and given back, 2 k / layer = 150 W m^-2 K^-1 times 265 K, on both sides.
    const double tolerance = 1e-7 + 2 * (1e-6 + 1e-9 * (250 + 150 * 265)) / slope;
    CHECK(largest_difference_k(day.surface_k, std::vector<double>(288, steady_k)) <= tolerance);
  }
}

TEST_CASE("The periodic day does not depend on the temperature that a body starts from") {
  // Days of ground anew, out of conduction and balance alone, from hot and cold starts and without moving to the
  // mean.
  GroundProperties ground = dry_soil();
  ground.thickness_m = 0.2;
  const auto forcing = forcing_of_day(winter(), 288);
  const auto from = [&](double start_k) {
    Conduction body(ground, {}, 300, start_k);
    std::vector<double> surface_k(288, start_k);
    // The slowest mode takes 4 L^2 / (pi^2 kappa) = 0.8 days with its surface held, and at most twice that behind an
    // exchange of 5 W m^-2 K^-1 or more (k / L is 1.5): 40 days leave exp(-25) of 60 K.
    double guess_k = start_k;
    for (int day = 0; day < 40; ++day) {
      for (std::size_t i = 0; i < forcing.size(); ++i) {
        const HeatUptake uptake = body.prepare();
        guess_k = SurfaceBalance(ground.surface)
                      .balanced_k(forcing[i], incoming_at(forcing[i], {}, forcing[i].air_k), uptake, guess_k);
        body.finish(guess_k);
        surface_k[i] = guess_k;
      }
    }
    return surface_k;
  };
  const std::vector<double> cold = from(230);
  const std::vector<double> hot = from(350);
  // Residuals of up to 1e-6 W m^-2 + 1e-9 * (1000 + 150 W m^-2 K^-1 * 300 K) over 5 W m^-2 K^-1, on both sides.
  CHECK(largest_difference_k(cold, hot) < 2e-5);
  const SurfaceDay day = day_of_ground(ground, {}, {forcing}, until(1e-7));
  CHECK(largest_difference_k(cold, day.surface_k) < 2e-5);
}

TEST_CASE("Between steps temperatures are straight lines, over midnight too") {
  const SurfaceDay day = {.surface_k = {280, 290, 300, 270}, .layers_k = {}};  // at 6, 12, 18 and 24 h
  CHECK(day.at_k(6) == 280);
  CHECK(day.at_k(12) == 290);
  CHECK(day.at_k(18) == 300);
  CHECK(day.at_k(0) == 270);
  CHECK(day.at_k(24) == 270);
  CHECK(day.at_k(-6) == 300);
  CHECK(day.at_k(48 + 9) == 285);
  CHECK(day.at_k(3) == 275);
  CHECK(day.at_k(21) == 285);
  CHECK_THAT(day.at_k(-1e-13), WithinAbs(270, 1e-9));
  CHECK_THAT(day.at_k(-1e-20), WithinAbs(270, 1e-9));
}

TEST_CASE("Dew warms a surface while it is below the dew point, and never cools one") {
  // The same sky and air, with and without the vapour near the surface, of ground that does not evaporate.
  DayWeather weather = winter();
  weather.vapour_hpa = 4.5;
  const auto humid = forcing_of_day(weather, 288);
  auto dry = humid;
  for (Forcing& forcing : dry) forcing.vapour_hpa = 0;
  GroundProperties ground = dry_soil();
  ground.surface.evaporation = 0;
  const HeatSteps steps = until(1e-5);
  const SurfaceDay with = day_of_ground(ground, {}, {humid}, steps);
  const SurfaceDay without = day_of_ground(ground, {}, {dry}, steps);
  int dewy = 0;
  double largest_gain_k = 0;
  double last_gain_k = 0;
  for (std::size_t i = 0; i < humid.size(); ++i) {
    const double gain_k = with.surface_k[i] - without.surface_k[i];
    CHECK(gain_k >= -2e-5);  // of both, what settling leaves
    if (saturation_hpa(with.surface_k[i]) < humid[i].vapour_hpa) {
      ++dewy;
      largest_gain_k = std::max(largest_gain_k, gain_k);
    }
    if (i == 144) last_gain_k = gain_k;  // noon
  }
  CAPTURE(dewy, largest_gain_k, last_gain_k);
  CHECK(dewy > 12);   // more than an hour of the night
  CHECK(dewy < 144);  // and not the day
  CHECK(largest_gain_k > 0.1);
  // The ground forgets the heat of the dew: at noon less than a tenth is left.
  CHECK(last_gain_k < 0.1 * largest_gain_k);
}

}  // namespace surface_day_test
