#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "heat/body/fire.h"
#include "heat/surface/conduction.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace warm_ground_test {

using namespace thermal;

namespace {

const GroundProperties kSand = {};

/// Excess after lying and after getting up, in fine layers: steps of 2 s.
struct Layered {
  double when_up_k = 0;
  std::vector<double> later_k;  ///< after each 300 s
};
Layered in_layers(const Lying& lying, double to_air_w_m2_k, int later) {
  constexpr double kStepS = 2;
  constexpr double kGroundK = 280;
  Conduction ground(kSand, {.first_m = 0.0004, .ratio = 1.1}, kStepS, kGroundK);
  // The surface gets conductance * (other - surface); it is where that is what the ground takes up.
  const auto step = [&](double conductance, double other_k) {
    const HeatUptake uptake = ground.prepare();
    const double surface_k =
        (conductance * other_k + uptake.offset_w_m2) / (conductance + uptake.slope_w_m2_k);
    ground.finish(surface_k);
    return surface_k - kGroundK;
  };
  Layered excess;
  for (double t = 0; t < lying.time_s; t += kStepS)
    excess.when_up_k = step(1 / lying.contact_m2_k_w, lying.body_k);
  for (int k = 0; k < later; ++k) {
    double last = 0;
    for (double t = 0; t < 300; t += kStepS) last = step(to_air_w_m2_k, kGroundK);
    excess.later_k.push_back(last);
  }
  return excess;
}

}  // namespace

TEST_CASE("The scaled error function is exp(x^2) erfc(x), far beyond where that overflows") {
  // mpmath 1.4.1, 40 digits.
  CHECK_THAT(scaled_erfc(0), WithinRel(1, 1e-15));
  CHECK_THAT(scaled_erfc(1), WithinRel(0.427583576155807004, 1e-14));
  CHECK_THAT(scaled_erfc(4.9), WithinRel(0.11287909055975875519, 1e-13));
  CHECK_THAT(scaled_erfc(5), WithinRel(0.110704637733068626, 1e-13));
  CHECK_THAT(scaled_erfc(30), WithinRel(0.018795888861416751497, 1e-12));
  CHECK_THAT(scaled_erfc(1e6), WithinRel(5.6418958354747419216e-7, 1e-12));
  CHECK(scaled_erfc(std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("Ground below a lying animal is as warm as in a computation in layers") {
  for (const double time_s : {600.0, 3600.0, 4 * 3600.0}) {
    const Lying lying = {.body_k = 309, .contact_m2_k_w = 0.08, .time_s = time_s};
    const double expected_k = in_layers(lying, 8, 0).when_up_k;
    CAPTURE(time_s);
    // Half a layer of 0.4 mm is 0.0007 m^2 K/W of 0.08; steps are of first order.
    CHECK_THAT(bed_excess_k(lying, {.inertia_j_m2_k_s = thermal_inertia(kSand)}, 280),
               WithinAbs(expected_k, 0.1));
  }
  CHECK(bed_excess_k({.time_s = 0}, {}, 280) == 0);
  CHECK_THAT(bed_excess_k({.body_k = 309, .time_s = 1e7}, {}, 280), WithinAbs(29, 1));
}

TEST_CASE("What is left of a bed's warmth is within 0.05 of a computation in layers") {
  for (const double time_s : {600.0, 3600.0, 4 * 3600.0}) {
    for (const double to_air : {0.0, 8.0, 20.0}) {
      const Lying lying = {.body_k = 309, .contact_m2_k_w = 0.01, .time_s = time_s};
      const WarmedGround ground = {.inertia_j_m2_k_s = thermal_inertia(kSand), .to_air_w_m2_k = to_air};
      const Layered expected = in_layers(lying, to_air, 24);
      double worst = 0;
      for (std::size_t k = 0; k < expected.later_k.size(); ++k) {
        const double share = bed_share_left(time_s, 300.0 * static_cast<double>(k + 1), ground);
        worst = std::max(worst, std::abs(share - expected.later_k[k] / expected.when_up_k));
      }
      CAPTURE(time_s, to_air, worst);
      CHECK(worst < 0.05);
    }
  }
}

TEST_CASE("A bed's warmth only falls") {
  const WarmedGround ground;
  CHECK(bed_share_left(3600, 0, ground) == 1);
  CHECK(bed_share_left(0, 10, ground) == 0);
  double before = 1;
  for (double since_s = 60; since_s < 1e6; since_s *= 1.5) {
    const double left = bed_share_left(3600, since_s, ground);
    CHECK(left < before);
    CHECK(left > 0);
    before = left;
  }
}

TEST_CASE("Warmed ground outside of its domain is refused") {
  CHECK(message_of<ConfigError>([] { WarmedGround{.inertia_j_m2_k_s = 0}.validate("ground"); }) ==
        "ground.inertia_j_m2_k_s = 0 J/(m^2 K s^0.5); expected 50 to 20000 J/(m^2 K s^0.5)");
  CHECK(message_of<ConfigError>([] { Lying{.contact_m2_k_w = 0}.validate("bed"); }) ==
        "bed.contact_m2_k_w = 0 m^2 K/W; expected 0.001 to 10 m^2 K/W");
}

}  // namespace warm_ground_test
