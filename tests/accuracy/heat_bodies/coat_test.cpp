#include <cmath>
#include <limits>

#include "accuracy/heat_bodies/nights.h"
#include "base/error.h"
#include "heat/body/skin.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace coat_test {

using namespace thermal;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double at(const Coat& coat, const Surroundings& around, double normal_z, double since_bath_s = kNever) {
  return coat_surface_k(coat, Activity::standing, since_bath_s, around.forcing,
                        incoming_on_slope(around, normal_z));
}

Surroundings indoors(double air_k, double wind) {
  Surroundings around = night(air_k, wind, air_k);
  around.forcing.sky_w_m2 = kStefanBoltzmann * std::pow(air_k, 4);
  return around;
}

const Coat kFace = {.tissue = {.warm_m2_k_w = 0.02, .cold_m2_k_w = 0.045},
                    .surface = {.albedo = 0.35, .emissivity = 0.98, .open_view = 0.85}};
const Coat kHand = {.tissue = {.warm_m2_k_w = 0.02, .cold_m2_k_w = 0.13},
                    .surface = {.albedo = 0.35, .emissivity = 0.98, .open_view = 0.85}};

}  // namespace

TEST_CASE("Bare hands are as the JOS-3 model has them") {
  // pythermalcomfort 4.8.1, JOS3, a clothed man of 70 kg after an hour, wind 1 m/s. It has one temperature for a hand;
  // fingers and persons differ by several kelvins (Chen et al. 1996: 2 to 17 K between hand and fingers at 273 K).
  constexpr double kHandK[][2] = {{273.15, 284.75}, {278.15, 288.05}, {283.15, 291.45},
                                  {288.15, 297.45}, {298.15, 306.65}, {303.15, 308.25}};
  for (const auto& [air_k, expected_k] : kHandK) {
    CAPTURE(air_k);
    CHECK_THAT(at(kHand, indoors(air_k, 1), 0), WithinAbs(expected_k, 3.5));
  }
}

TEST_CASE("A bare face is warm in a cool room and cold in wind") {
  // Forehead 34.7 deg C in a cool room; a cheek insulates at most 0.07 m^2 K/W (Osczevski, DCIEM 94-47, 1994).
  CHECK_THAT(at(kFace, indoors(295.15, 0.1), 0), WithinAbs(307.85, 1.5));
  const double calm = at(kFace, indoors(273.15, 0.2), 0);
  const double windy = at(kFace, indoors(273.15, 5), 0);
  CHECK(calm > 295);
  CHECK(calm < 303);
  CHECK(windy < calm - 8);
  CHECK(windy > 282);
}

TEST_CASE("Skin follows the air within its domain and has a temperature beyond it") {
  double before = 0;
  for (double air_k = 203; air_k <= 343; air_k += 1) {
    const double t = at(kHand, indoors(air_k, 1), 0);
    CHECK(t > before);
    before = t;
  }
  CHECK(before < 343);
}

TEST_CASE("A thicker coat is colder at night and its tissue does not matter") {
  const Coat hide = {.coat_m2_k_w = 0.1};
  double before = 400;
  for (const double coat_m2_k_w : {0.0, 0.05, 0.1, 0.3, 1.0, 10.0}) {
    Coat coat = hide;
    coat.coat_m2_k_w = coat_m2_k_w;
    const double t = at(coat, cold_night(), 0);
    CHECK(t < before);
    before = t;
  }
  CHECK(at(hide, warm_night(), -1) > at(hide, warm_night(), 1));
}

TEST_CASE("A coat in the sun cools within the stored heat's minutes, so a balance has no memory") {
  // Parker and Harlan's deer: -18 K within 120 s of shade. The balance has it at once.
  const Coat deer = {.coat_m2_k_w = 0.25, .surface = {.albedo = 0.25, .emissivity = 0.98, .diameter_m = 0.4}};
  Surroundings shade = sunny_day(293, 0.5);
  const double sunlit =
      coat_surface_k(deer, Activity::standing, kNever, shade.forcing, incoming_on(shade, shade.forcing.sun));
  shade.sunlit = 0;
  const double shaded =
      coat_surface_k(deer, Activity::standing, kNever, shade.forcing, incoming_on(shade, shade.forcing.sun));
  CHECK(sunlit - shaded > 12);
  CHECK(sunlit - shaded < 45);
}

TEST_CASE("An animal that bathed is colder until it is dry") {
  const Coat hippopotamus = {.tissue = {.core_k = 308.5}, .wet_when_bathed = 1, .drying_s = 1800};
  const double dry = at(hippopotamus, warm_night(), 0);
  double before = 0;
  for (const double since_s : {0.0, 300.0, 900.0, 1800.0, 3600.0, 14400.0}) {
    const double t = at(hippopotamus, warm_night(), 0, since_s);
    CHECK(t > before);
    before = t;
  }
  CHECK(at(hippopotamus, warm_night(), 0, 0) < dry - 3);
  CHECK_THAT(before, WithinAbs(dry, 0.01));
  CHECK(wet_share(hippopotamus, 0) == 1);
  CHECK_THAT(wet_share(hippopotamus, 1800), WithinRel(std::exp(-1), 1e-12));
  CHECK(wet_share(hippopotamus, kNever) == 0);
}

TEST_CASE("A cold-blooded animal is near the water that it came from") {
  const Surroundings around = cold_night();
  const ColdBlooded crocodile;
  const double t = cold_blooded_surface_k(crocodile, 290, around.forcing, incoming_on_slope(around, 0));
  CHECK(t > 276);
  CHECK(t < 291);
  CHECK(cold_blooded_surface_k({.tissue_m2_k_w = 1e-4}, 290, around.forcing, incoming_on_slope(around, 0)) >
        290);
}

TEST_CASE("Walking warms the hands") {
  const Surroundings around = night(283, 0.5, 280);
  const Incoming side = incoming_on_slope(around, 0);
  CHECK(coat_surface_k(kHand, Activity::walking, kNever, around.forcing, side) >
        coat_surface_k(kHand, Activity::standing, kNever, around.forcing, side));
}

TEST_CASE("Coats outside of their domain are refused") {
  CHECK(message_of<ConfigError>([] { Coat{.coat_m2_k_w = -1}.validate("torso"); }) ==
        "torso.coat_m2_k_w = -1 m^2 K/W; expected 0 to 10 m^2 K/W");
  CHECK(message_of<ConfigError>([] { Coat{.drying_s = 0}.validate("torso"); }) ==
        "torso.drying_s = 0 s; expected 1 to 1000000 s");
  CHECK(message_of<ConfigError>([] { ColdBlooded{.above_k = 30}.validate("torso"); }) ==
        "torso.above_k = 30 K; expected -20 to 20 K");
}

}  // namespace coat_test
