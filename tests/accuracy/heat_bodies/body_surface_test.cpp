#include "heat/body/body_surface.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "accuracy/heat_bodies/nights.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace body_surface_test {

using namespace thermal;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double at(const BodySurface& surface, const HeatWithin& within, const Surroundings& around, double normal_z) {
  return body_surface_k(surface, within, around.forcing, incoming_on_slope(around, normal_z));
}

}  // namespace

TEST_CASE("A body's balance closes in all weather that Earth has") {
  for (const double air_k : {233.0, 253.0, 273.0, 293.0, 323.0}) {
    for (const double wind : {0.0, 0.3, 1.0, 5.0, 20.0}) {
      for (const double wet : {0.0, 0.5, 1.0}) {
        for (const double diameter_m : {0.0, 0.02, 1.5}) {
          for (const double conductance : {0.0, 2.0, 50.0, 1e4}) {
            const BodySurface surface = {.diameter_m = diameter_m, .wet = wet};
            const HeatWithin within = {.inside_k = 310, .w_m2_k = conductance};
            for (const Surroundings& around : {night(air_k, wind, air_k - 5), sunny_day(air_k, wind)}) {
              const double t = at(surface, within, around, 0.3);
              CAPTURE(air_k, wind, wet, diameter_m, conductance, t);
              const SurfaceFlux left =
                  body_flux(surface, within, around.forcing, incoming_on_slope(around, 0.3), t);
              // The documented step of 1e-6 K.
              CHECK(std::abs(left.flux_w_m2) <= 1e-7 - 1e-6 * left.slope_w_m2_k);
              CHECK(t > 200);
              CHECK(t < 420);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("A body has the temperature within if nothing insulates it, and none of it if everything does") {
  const Surroundings around = cold_night();
  CHECK(at({}, {.inside_k = 310, .w_m2_k = kInfinite}, around, 0) == 310);
  CHECK_THAT(at({}, {.inside_k = 310, .w_m2_k = 1e9}, around, 0), WithinAbs(310, 1e-6));
  // Without heat from within, radiation at the air's temperature from everywhere leaves the air's temperature.
  Surroundings even = night(280, 1, 280);
  even.forcing.sky_w_m2 = kStefanBoltzmann * std::pow(280, 4);
  CHECK_THAT(at({}, {.inside_k = 310}, even, 0.4), WithinAbs(280, 1e-9));
  // In calm air, and as good as without convection at such small differences: mean radiant temperature.
  Surroundings still = night(280, 0, 280.5);
  still.forcing.sky_w_m2 = kStefanBoltzmann * std::pow(280.5, 4);
  const double t = at({}, {}, still, 0);
  CHECK(t > 280);
  CHECK(t < 280.5);
}

TEST_CASE("A body is warmer in warmer air, below a warmer sky and above warmer ground, and cooler in wind") {
  const HeatWithin within = {.inside_k = 310, .w_m2_k = 8};
  double before = 0;
  for (double air_k = 233; air_k <= 323; air_k += 2) {
    Surroundings around = cold_night();
    around.forcing.air_k = air_k;
    around.forcing.vapour_hpa = 0;
    const double t = at({}, within, around, 0);
    CHECK(t > before);
    before = t;
  }
  before = 400;
  for (double wind = 0; wind <= 20; wind += 0.5) {
    const double t = at({}, within, night(273, wind, 268), 0);
    CHECK(t <= before);  // as long as free convection is the larger, the same
    before = t;
  }
  before = 0;
  for (double sky = 100; sky <= 450; sky += 25) {
    Surroundings around = cold_night();
    around.forcing.sky_w_m2 = sky;
    const double t = at({}, within, around, 0.5);
    CHECK(t > before);
    before = t;
  }
  before = 0;
  for (double ground_k = 250; ground_k <= 320; ground_k += 5) {
    const double t = at({}, within, night(273, 1, ground_k), -0.5);
    CHECK(t > before);
    before = t;
  }
}

TEST_CASE("At night a back is colder than a belly, by more below a cold sky") {
  const HeatWithin within = {.inside_k = 310, .w_m2_k = 5};
  const double back = at({}, within, cold_night(), 1);
  const double belly = at({}, within, cold_night(), -1);
  CHECK(belly > back + 1);
  Surroundings covered = cold_night();
  covered.sky_view = 0.3;
  CHECK(at({}, within, covered, 1) > back + 1);
  CHECK_THAT(at({}, within, covered, -1), WithinAbs(belly, 1e-9));
}

TEST_CASE("Wind takes as much as the named formulas say") {
  const Forcing forcing = {.air_k = 293.15, .wind_m_s = 4, .pressure_hpa = 1013.25};
  CHECK_THAT(body_convection({}, forcing, 294.15), WithinRel(24.2, 1e-12));
  // Re = 4 * 0.1 / 1.51e-5 = 26490, Nu = 0.24 Re^0.6 = 108.2, h = Nu * 0.0257 / 0.1; to 4 digits.
  CHECK_THAT(body_convection({.diameter_m = 0.1}, forcing, 294.15), WithinRel(27.81, 2e-3));
  const Forcing calm = {.air_k = 293.15, .wind_m_s = 0, .pressure_hpa = 1013.25};
  CHECK_THAT(body_convection({}, calm, 293.15 + 16), WithinRel(2.38 * 2, 1e-9));
}

TEST_CASE("Evaporation cools a body without heat down to between the wet bulb and the air") {
  const Surroundings around = night(293, 3, 293);
  const Incoming even = {.longwave_w_m2 = kStefanBoltzmann * std::pow(293, 4)};
  const double wet = body_surface_k({.diameter_m = 0.3, .wet = 1}, {}, around.forcing, even);
  // Psychrometer at 293 K, 70 % and 907 hPa: 289.5 K; radiation warms it.
  CHECK(wet > 289.3);
  CHECK(wet < 291);
  double before = 0;
  for (double share = 1; share >= 0; share -= 0.1) {
    const double t = body_surface_k({.diameter_m = 0.3, .wet = share}, {}, around.forcing, even);
    CHECK(t > before);
    before = t;
  }
}

TEST_CASE("Dew warms a body that is colder than the dew point") {
  Surroundings humid = warm_night();
  humid.forcing.vapour_hpa = saturation_hpa(293);
  Surroundings dry = humid;
  dry.forcing.vapour_hpa = 0;
  CHECK(at({}, {}, humid, 1) > at({}, {}, dry, 1) + 1);
}

TEST_CASE("The mean over azimuths of a slope is that of its directions") {
  const Surroundings day = sunny_day(293, 2);
  for (const double up : {-1.0, -0.8, -0.3, 0.0, 0.2, 0.6, 0.7, 0.95, 1.0}) {
    constexpr int kDirections = 20000;
    double sun = 0;
    double longwave = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * k / kDirections;
      const double across = std::sqrt(1 - up * up);
      const Incoming one = incoming_on(day, {across * std::cos(angle), across * std::sin(angle), up});
      sun += one.sun_w_m2 / kDirections;
      longwave += one.longwave_w_m2 / kDirections;
    }
    const Incoming mean = incoming_on_slope(day, up);
    CAPTURE(up);
    // The trapezoidal rule errs by (2 pi / n)^2 / 12 of 780 W m^-2 at the kink where the sun goes behind the surface.
    CHECK_THAT(mean.sun_w_m2, WithinAbs(sun, 1e-4));
    CHECK_THAT(mean.longwave_w_m2, WithinAbs(longwave, 1e-9));
  }
}

TEST_CASE("NaN passes through a body's balance") {
  Surroundings around = cold_night();
  around.forcing.air_k = std::nan("");
  CHECK(std::isnan(at({}, {.inside_k = 310, .w_m2_k = 5}, around, 0)));
}

TEST_CASE("Surfaces outside of their domain are refused") {
  CHECK(message_of<ConfigError>([] { BodySurface{.open_view = 0}.validate("skin"); }) ==
        "skin.open_view = 0; expected above 0 and at most 1");
  CHECK(message_of<ConfigError>([] { BodySurface{.diameter_m = 9}.validate("skin"); }) ==
        "skin.diameter_m = 9 m; expected 0.002 to 5 m");
  CHECK(message_of<ConfigError>([] { BodySurface{.wet = std::nan("")}.validate("skin"); }) ==
        "skin.wet = nan; expected 0 to 1");
}

}  // namespace body_surface_test
