#include "heat/surface/surface_balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "heat/weather/humid_air.h"
#include "support/catch.h"

namespace surface_balance_test {

using namespace thermal;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Real = long double;

Real fourth(Real x) { return x * x * x * x; }

Real clamp(Real value, Real low, Real high) { return std::min(std::max(value, low), high); }

/// The balance written down anew from the docstrings, with 64 bits of mantissa: what a surface gets from above at a
/// temperature.
struct Balance {
  Forcing forcing;
  Incoming incoming;
  SurfaceProperties surface;
  HeatUptake uptake;

  [[nodiscard]] Real exchange(Real surface_k) const {
    if (surface.roughness_m == 0) return 2.8L + 3.0L * forcing.wind_m_s;
    const Real rough_m = surface.roughness_m;
    const Real wind = std::max<Real>(forcing.wind_m_s, 0.3L);
    const Real neutral = 0.16L / (std::log(2 / rough_m) * std::log(2 / (rough_m / 10)));
    const Real mean_k = (forcing.air_k + surface_k) / 2;
    const Real richardson = clamp(9.81L * 2 * (forcing.air_k - surface_k) / (mean_k * wind * wind), -5, 2);
    Real stability = 1;
    if (richardson > 0) stability = 1 / (1 + 15 * richardson * std::sqrt(1 + 5 * richardson));
    if (richardson < 0)
      stability = 1 - 15 * richardson / (1 + 75 * neutral * std::sqrt(2 / rough_m * -richardson));
    const Real density = 100 * static_cast<Real>(forcing.pressure_hpa) / (287.05L * forcing.air_k);
    return 1005 * density * neutral * wind * stability + 1.5L;
  }

  [[nodiscard]] Real vapour(Real surface_k) const {
    const Real celsius = clamp(surface_k, 190, 420) - 273.15L;
    const Real saturated = 6.112L * std::exp(17.62L * celsius / (243.12L + celsius));
    return 0.622L * (saturated - forcing.vapour_hpa) / forcing.pressure_hpa;
  }

  [[nodiscard]] Real from_above(Real surface_k) const {
    const Real h = exchange(surface_k);
    const Real more = vapour(surface_k);
    const Real wet = more < 0 ? 1 : static_cast<Real>(surface.evaporation);
    return (1 - static_cast<Real>(surface.albedo)) * incoming.sun_w_m2 +
           surface.emissivity * (incoming.longwave_w_m2 - 5.670374419e-8L * fourth(surface_k)) -
           h * (surface_k - forcing.air_k) - wet * 2.47e6L / 1005 * h * more;
  }

  /// What is left over at a temperature; 0 at the balance.
  [[nodiscard]] Real left(Real surface_k) const {
    return from_above(surface_k) - uptake.slope_w_m2_k * surface_k + uptake.offset_w_m2;
  }

  [[nodiscard]] double solved_k(double guess_k) const {
    return SurfaceBalance(surface).balanced_k(forcing, incoming, uptake, guess_k);
  }

  /// The docstring's bound of 1e-6 K, for a body that takes this much up and a surface that gives off less than
  /// 4000 W m^-2 K^-1; and the roundings of the largest flux.
  [[nodiscard]] Real bound_w_m2() const {
    return 1e-6L * (static_cast<Real>(uptake.slope_w_m2_k) + 4000) +
           1e-14L * static_cast<Real>(std::abs(uptake.offset_w_m2));
  }

  /// The residual is within the bound, or changes its sign within 1e-9 K.
  [[nodiscard]] bool balances(double surface_k) const {
    if (std::abs(left(surface_k)) <= bound_w_m2()) return true;
    return left(surface_k - 1.01e-9L) > 0 && left(surface_k + 1.01e-9L) < 0;
  }

  [[nodiscard]] Real root() const {
    Real low = 100;
    Real high = 1000;
    for (int round = 0; round < 80; ++round) {
      const Real middle = (low + high) / 2;
      (left(middle) > 0 ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  /// How often the balance changes its sign on a grid of 0.05 K.
  [[nodiscard]] int roots() const {
    int changes = 0;
    for (int i = 0; i < 18000; ++i)
      changes += (left(100 + 0.05L * i) > 0) != (left(100 + 0.05L * (i + 1)) > 0) ? 1 : 0;
    return changes;
  }
};

Forcing air(double air_k, double wind_m_s, double relative_humidity, double cloud) {
  Forcing forcing;
  forcing.air_k = air_k;
  forcing.wind_m_s = wind_m_s;
  forcing.vapour_hpa = relative_humidity * saturation_hpa(air_k);
  forcing.pressure_hpa = 900;
  forcing.sky_w_m2 =
      broadband_sky_emissivity(air_k, forcing.vapour_hpa, cloud) * kStefanBoltzmann * std::pow(air_k, 4);
  return forcing;
}

/// Calls `check` with the balances of cold to hot air, calm to storm, dry to saturated, clear to overcast, night and
/// day, smooth to rough, and what takes up no heat up to a body that hardly changes.
template <typename Check>
void for_each_balance(const Check& check) {
  for (const double air_k : {200.0, 273.15, 300.0, 333.15}) {
    for (const double wind_m_s : {0.0, 0.3, 2.0, 60.0}) {
      for (const double humidity : {0.0, 0.5, 1.0}) {
        for (const double cloud : {0.0, 0.5, 1.0}) {
          const Forcing forcing = air(air_k, wind_m_s, humidity, cloud);
          for (const double sun_w_m2 : {0.0, 1100.0}) {
            for (const double roughness_m : {0.0, 1e-5, 0.005, 0.5}) {
              for (const double evaporation : {0.0, 1.0}) {
                for (const double slope : {0.0, 10.0, 5000.0}) {
                  check(Balance{.forcing = forcing,
                                .incoming = {.sun_w_m2 = sun_w_m2, .longwave_w_m2 = forcing.sky_w_m2},
                                .surface = {.roughness_m = roughness_m, .evaporation = evaporation},
                                .uptake = {.slope_w_m2_k = slope, .offset_w_m2 = slope * (air_k + 5)}});
                }
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("The flux from above is the sum of its terms, for any weather and surface") {
  for_each_balance([](const Balance& balance) {
    for (const double surface_k : {150.0, 200.0, 265.0, 273.15, 333.15, 500.0}) {
      const double expected = static_cast<double>(balance.from_above(surface_k));
      const double flux =
          SurfaceBalance(balance.surface).flux(balance.forcing, balance.incoming, surface_k).flux_w_m2;
      // Sums of products of ten factors: 20 roundings of the largest term, of which the exchange with the air may be
      // 1e6.
      const double h = static_cast<double>(balance.exchange(surface_k));
      const double largest = 1e4 + h * std::abs(surface_k - balance.forcing.air_k) +
                             3000 * h * std::abs(static_cast<double>(balance.vapour(surface_k))) +
                             h * balance.forcing.air_k;
      if (std::abs(flux - expected) > 20 * 2.3e-16 * largest)
        CHECK_THAT(flux, WithinAbs(expected, 20 * 2.3e-16 * largest));
    }
  });
}

TEST_CASE("A balanced surface meets the bound of its residual") {
  int balances = 0;
  for_each_balance([&](const Balance& balance) {
    for (const double guess_k : {200.0, 333.15}) {
      const double surface_k = balance.solved_k(guess_k);
      ++balances;
      if (balance.balances(surface_k)) continue;
      CAPTURE(balance.forcing.air_k, balance.forcing.wind_m_s, balance.forcing.vapour_hpa,
              balance.incoming.sun_w_m2, balance.surface.roughness_m, balance.surface.evaporation,
              balance.uptake.slope_w_m2_k, guess_k, surface_k, static_cast<double>(balance.root()));
      CHECK(static_cast<double>(std::abs(balance.left(surface_k))) <=
            static_cast<double>(balance.bound_w_m2()));
    }
  });
  CHECK(balances == 4 * 4 * 3 * 3 * 2 * 4 * 2 * 3 * 2);
}

TEST_CASE("From any guess a surface comes to the same temperature, that of an independent bisection") {
  for (const double air_k : {200.0, 250.0, 273.15, 293.0, 333.15}) {
    for (const double wind_m_s : {0.0, 1.0, 4.0}) {
      for (const double humidity : {0.0, 0.6, 1.0}) {
        for (const double sun_w_m2 : {0.0, 800.0}) {
          const Forcing forcing = air(air_k, wind_m_s, humidity, 0);
          const Balance balance = {.forcing = forcing,
                                   .incoming = {.sun_w_m2 = sun_w_m2, .longwave_w_m2 = forcing.sky_w_m2},
                                   .surface = {},
                                   .uptake = {.slope_w_m2_k = 20, .offset_w_m2 = 20 * air_k}};
          CAPTURE(air_k, wind_m_s, humidity, sun_w_m2);
          REQUIRE(balance.roots() == 1);
          // A residual of up to the bound moves the root by its ratio to the slope, at least that of the uptake less
          // what the air's stability gives back: 10 W m^-2 K^-1 here (checked).
          const Real root = balance.root();
          const Real slope = (balance.left(root - 1e-3L) - balance.left(root + 1e-3L)) / 2e-3L;
          REQUIRE(slope > 10);
          const double tolerance = static_cast<double>(balance.bound_w_m2() / 10) + 1e-9;
          for (const double guess_k : {100.0, 200.0, air_k, 400.0, 1000.0, -5.0, 1e9})
            CHECK_THAT(balance.solved_k(guess_k), WithinAbs(static_cast<double>(root), tolerance));
        }
      }
    }
  }
}

TEST_CASE("Surfaces of a body that takes no heat come to the temperature where radiation and air balance") {
  // Without wind, vapour and sun, in air whose sky is as warm as it: the air's temperature.
  for (const double air_k : {200.0, 273.15, 333.15}) {
    const Forcing forcing = air(air_k, 1, 0, 0);
    const Incoming incoming = {.longwave_w_m2 = kStefanBoltzmann * std::pow(air_k, 4)};
    const double surface_k =
        SurfaceBalance(SurfaceProperties{.evaporation = 0}).balanced_k(forcing, incoming, {}, 260);
    // The bound over the least slope of radiation, 4 * 0.93 sigma T^3 = 1.69 at 200 K.
    CHECK_THAT(surface_k, WithinAbs(air_k, 1e-4 / 1.6));
  }
}

TEST_CASE("What is not a number stays so, in every input") {
  const Forcing good = air(280, 1, 0.5, 0);
  const Incoming incoming = {.longwave_w_m2 = good.sky_w_m2};
  const HeatUptake uptake = {.slope_w_m2_k = 10, .offset_w_m2 = 2800};
  const auto with = [&](auto change) {
    Balance balance = {.forcing = good, .incoming = incoming, .surface = {}, .uptake = uptake};
    change(balance);
    return balance.solved_k(280);
  };
  CHECK(std::isfinite(with([](Balance&) {})));
  CHECK(std::isnan(with([](Balance& b) { b.forcing.air_k = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.forcing.wind_m_s = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.forcing.vapour_hpa = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.forcing.pressure_hpa = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.incoming.sun_w_m2 = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.incoming.longwave_w_m2 = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.surface.albedo = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.surface.emissivity = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.uptake.slope_w_m2_k = kNaN; })));
  CHECK(std::isnan(with([](Balance& b) { b.uptake.offset_w_m2 = kNaN; })));
  CHECK(std::isnan(SurfaceBalance(SurfaceProperties{}).balanced_k(good, incoming, uptake, kNaN)));
}

TEST_CASE(
    "Below the dew point every surface gains the heat of what condenses; above it a dry one loses none") {
  for (const double evaporation : {0.0, 0.5, 1.0}) {
    const Forcing humid = air(290, 2, 0.8, 0);
    Forcing dry = humid;
    dry.vapour_hpa = 0;
    const Incoming incoming = {.longwave_w_m2 = humid.sky_w_m2};
    const SurfaceProperties surface = {.evaporation = evaporation};
    const auto gained_w_m2 = [&](double surface_k) {
      // Against a surface that neither evaporates nor gets dew.
      return SurfaceBalance(surface).flux(humid, incoming, surface_k).flux_w_m2 -
             SurfaceBalance(SurfaceProperties{.evaporation = 0}).flux(dry, incoming, surface_k).flux_w_m2;
    };
    const double dew_k = [&] {
      const double x = std::log(humid.vapour_hpa / 6.112);
      return 243.12 * x / (17.62 - x) + 273.15;
    }();
    CAPTURE(evaporation, dew_k);
    // Magnus' formula and its inverse agree to rounding: 1e-10 K.
    for (const double below_k : {1e-6, 0.1, 5.0, 20.0}) {
      const Balance balance = {.forcing = humid, .incoming = incoming, .surface = surface, .uptake = {}};
      const auto expected = static_cast<double>(-2.47e6L / 1005 * balance.exchange(dew_k - below_k) *
                                                balance.vapour(dew_k - below_k));
      CHECK(expected > 0);
      CHECK_THAT(gained_w_m2(dew_k - below_k), WithinAbs(expected, 1e-9));
      CHECK_THAT(
          gained_w_m2(dew_k + below_k),
          WithinAbs(evaporation * static_cast<double>(-2.47e6L / 1005 * balance.exchange(dew_k + below_k) *
                                                      balance.vapour(dew_k + below_k)),
                    1e-9));
    }
    CHECK_THAT(gained_w_m2(dew_k), WithinAbs(0, 1e-6));  // no step: 1e-10 K of up to 1e3 W m^-2 K^-1
  }
}

TEST_CASE(
    "Level open ground gets the sky, the beam times the sun's sine and the diffuse light, and no more") {
  Forcing forcing = air(290, 2, 0.5, 0);
  forcing.sun = {0.6, 0, 0.8};
  forcing.beam_w_m2 = 700;
  forcing.diffuse_w_m2 = 100;
  forcing.global_w_m2 = 660;
  const Incoming open = incoming_at(forcing, {}, 999);
  CHECK_THAT(open.sun_w_m2, WithinRel(660, 1e-15));
  CHECK_THAT(open.longwave_w_m2, WithinRel(forcing.sky_w_m2, 1e-15));
  // A wall that faces east sees half sky, half ground.
  const Incoming wall = incoming_at(forcing, {.normal = {1, 0, 0}}, 300);
  CHECK_THAT(wall.sun_w_m2, WithinRel(0.6 * 700 + 0.5 * 100 + 0.2 * 0.5 * 660, 1e-15));
  CHECK_THAT(wall.longwave_w_m2,
             WithinRel(0.5 * forcing.sky_w_m2 + 0.5 * kStefanBoltzmann * std::pow(300.0, 4), 1e-15));
  // One that faces west has no beam.
  const Incoming shade = incoming_at(forcing, {.normal = {-1, 0, 0}}, 300);
  CHECK_THAT(shade.sun_w_m2, WithinRel(0.5 * 100 + 0.2 * 0.5 * 660, 1e-15));
  // Trees of the air's temperature hide three quarters of the sky, and let a third of the beam through.
  const Incoming below = incoming_at(forcing, {.sky_view = 0.25, .sunlit = 1.0 / 3}, 999);
  CHECK_THAT(below.sun_w_m2, WithinRel(0.8 * 700 / 3 + 0.25 * 100 + 0.2 * 0.75 * 660 / 3, 1e-15));
  CHECK_THAT(below.longwave_w_m2,
             WithinRel(0.25 * forcing.sky_w_m2 + 0.75 * kStefanBoltzmann * std::pow(290.0, 4), 1e-15));
}

TEST_CASE("The slope of the flux is that of its difference, with the exchange held") {
  for (const double evaporation : {0.0, 1.0}) {
    for (const double surface_k : {230.0, 280.0, 310.0}) {
      // A body in the wind: its exchange does not depend on its temperature.
      const Forcing forcing = air(285, 3, 0.4, 0);
      const SurfaceProperties surface = {.roughness_m = 0, .evaporation = evaporation};
      const auto flux = [&](double at_k) { return SurfaceBalance(surface).flux(forcing, {}, at_k); };
      const double step_k = 0.01;
      const double difference =
          (flux(surface_k + step_k).flux_w_m2 - flux(surface_k - step_k).flux_w_m2) / (2 * step_k);
      // Third derivatives: vapour's grows by 7 % per kelvin, (0.07 * 0.01)^2 / 6 of up to 100; radiation's less.
      CHECK_THAT(flux(surface_k).slope_w_m2_k, WithinRel(difference, 1e-6));
      CHECK(flux(surface_k).slope_w_m2_k < 0);
    }
  }
}

}  // namespace surface_balance_test
