#include "heat/weather/air_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "heat/surface/surface_day.h"
#include "support/catch.h"

// Air above ground that has cooled: Monin-Obukhov profiles against closed forms and limits.
namespace air_profile_test {

using namespace thermal;

namespace {

constexpr double kRoughnessM = 0.03;
constexpr double kLapseKM = 0.0098;

Forcing night(double wind_m_s) { return {.air_k = 273, .wind_m_s = wind_m_s, .pressure_hpa = 910}; }

/// Without the lapse that it takes off.
double potential_k(const StableAir& air, double height_m) {
  return air.warmer_k(height_m) + kLapseKM * (height_m - 2);
}

}  // namespace

TEST_CASE("In strong wind the profile is that of neutral air, a straight line in the logarithm of height") {
  const StableAir air(night(60), 268);
  CHECK(air.stability() < 1e-3);
  const double expected_k = 5 * std::log(10.0 / 2) / std::log(2 / (0.1 * kRoughnessM));
  // The gradient is 1 + 5.2 z / L, up to 10 m, instead of 1.
  CHECK_THAT(potential_k(air, 10), WithinRel(expected_k, 5.2 * 5 * air.stability()));
}

TEST_CASE("Up to 2 m above the Obukhov length, stability solves its quadratic equation") {
  for (const double wind_m_s : {1.0, 2.0, 4.0, 8.0}) {
    CAPTURE(wind_m_s);
    const double ground_k = 272.5;
    const StableAir air(night(wind_m_s), ground_k);
    REQUIRE(air.stability() > 0);
    REQUIRE(air.stability() <= 1);
    const double richardson = 9.81 * 2 * 0.5 / (0.5 * (273 + ground_k) * wind_m_s * wind_m_s);
    // s (h + 5.2 s (1 - a / 10)) = Ri (m + 5.2 s (1 - a))^2; m, h: logarithms of 2 m over the roughnesses a and a / 10.
    const double a = kRoughnessM / 2;
    const double m = -std::log(a);
    const double h = -std::log(0.1 * a);
    const double c = 5.2 * (1 - a);
    const double square = 5.2 * (1 - 0.1 * a) - richardson * c * c;
    const double linear = h - 2 * richardson * m * c;
    const double expected =
        (-linear + std::sqrt(linear * linear + 4 * square * richardson * m * m)) / (2 * square);
    CHECK_THAT(air.stability(), WithinRel(expected, 1e-12));
  }
}

TEST_CASE("The gradient is Webb's below the Obukhov length and above it") {
  for (const double wind_m_s : {0.3, 1.0, 3.0}) {
    const StableAir air(night(wind_m_s), 268);
    const auto gradient = [&](double height_m) {
      constexpr double kStep = 1e-4;
      return (potential_k(air, height_m * (1 + kStep)) - potential_k(air, height_m * (1 - kStep))) /
             (2 * kStep);
    };
    // Over a kelvin of the scale, 1 + 5.2 z / L; the ratio of two heights knows no scale.
    const auto webb = [&](double height_m) {
      return 1 + 5.2 * std::min(1.0, height_m / 2 * air.stability());
    };
    for (const double height_m : {2.5, 4.0, 8.0, 20.0, 61.0, 122.0}) {
      CAPTURE(wind_m_s, height_m);
      // Central differences err by the square of the step; they straddle the corner at z = L in no case here.
      CHECK_THAT(gradient(height_m) / gradient(100), WithinRel(webb(height_m) / webb(100), 1e-6));
    }
  }
}

TEST_CASE("Calm clear nights have an inversion of some kelvins; wind, clouds and sunlight end it") {
  // Air at 5 to 8 m is 1 to 2 K warmer where the ground is 5 K colder than the air.
  const StableAir calm(night(1), 268);
  CHECK(calm.warmer_k(5) > 1);
  CHECK(calm.warmer_k(8) < 2.1);
  CHECK(calm.warmer_k(61) > 3);
  CHECK(calm.warmer_k(61) < 6);
  CHECK(StableAir(night(8), 272.5).warmer_k(61) == 0);  // the lapse is more
  double before_k = 0;
  for (const double ground_k : {273.0, 272.0, 270.0, 266.0, 260.0}) {
    const double now_k = StableAir(night(1), ground_k).warmer_k(61);
    CHECK(now_k >= before_k);
    before_k = now_k;
  }
}

TEST_CASE("Below 2 m, over warm ground and for what is no number, air is as at 2 m") {
  CHECK(StableAir(night(1), 273).warmer_k(61) == 0);
  CHECK(StableAir(night(1), 300).warmer_k(61) == 0);
  CHECK(StableAir(night(1), 300).stability() == 0);
  CHECK(StableAir(night(1), std::numeric_limits<double>::quiet_NaN()).warmer_k(61) == 0);
  const StableAir air(night(1), 268);
  CHECK(air.warmer_k(2) == 0);
  CHECK(air.warmer_k(-5) == 0);
  CHECK(air.warmer_k(1e9) == air.warmer_k(150));
  CHECK(StableAir(night(0), 268).warmer_k(61) == StableAir(night(0.3), 268).warmer_k(61));
}

TEST_CASE("Leaves of trees take the temperature of the air at their height, those of grass do not") {
  const std::vector<Forcing> forcing = forcing_of_day(DayWeather(), 288);
  const std::vector<double> ground_k = day_of_ground({}, {}, {.forcing = forcing}, {}).surface_k;
  const auto leaves_k = [&](double height_m, bool stable) {
    // Small leaves in a dense wood, below which the sky is not seen: nearly the temperature of their air.
    const CanopyProperties canopy = {
        .leaf_area_index = 0.9, .leaf_width_m = 0.0005, .height_m = height_m, .heat_capacity_j_m2_k = 10};
    DayAround around = {.forcing = forcing};
    if (stable) around.ground_k = ground_k;
    return day_of_canopy(canopy, {}, {.sky_view = 0}, around, {}).leaves.at_k(3);
  };
  const std::size_t at_3 = 3 * 12 - 1;
  const double warmer_k = StableAir(forcing[at_3], ground_k[at_3]).warmer_k(6);
  CHECK(warmer_k > 1);
  CHECK_THAT(leaves_k(6, true) - leaves_k(6, false), WithinRel(warmer_k, 0.05));
  CHECK(leaves_k(2, true) == leaves_k(2, false));
}

}  // namespace air_profile_test
