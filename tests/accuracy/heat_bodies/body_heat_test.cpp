#include "heat/body/body_heat.h"

#include <vector>

#include "accuracy/heat_bodies/nights.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace body_heat_test {

using namespace thermal;

namespace {

const Coat kBareHand = {.tissue = {.warm_m2_k_w = 0.02, .cold_m2_k_w = 0.13}, .surface = {.open_view = 0.85}};
const Coat kHide = {.coat_m2_k_w = 0.1, .wet_when_bathed = 1};

std::vector<BodyHeat> all_kinds() {
  return {BodyHeat{},
          Clothing{},
          kBareHand,
          kHide,
          ColdBlooded{},
          Unheated{},
          Sheet{},
          EngineWarmed{.warmth = {.driving_k = 20, .parked_k = 30}},
          Powered{.excess_k = 40}};
}

}  // namespace

TEST_CASE("Every kind of part has a temperature in all weather, on every slope") {
  for (const BodyHeat& heat : all_kinds()) {
    for (const double air_k : {233.15, 253.0, 273.0, 293.0, 323.15}) {
      for (const double wind : {0.0, 0.5, 3.0, 20.0}) {
        for (const Surroundings& around : {night(air_k, wind, air_k - 6), sunny_day(air_k, wind)}) {
          for (const double up : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0}) {
            const double t = part_temperature_k(heat, {.around = around, .since_bath_s = 0}, up);
            CAPTURE(heat.index(), air_k, wind, up, t);
            CHECK(t > 215);
            CHECK(t < 420);
          }
        }
      }
    }
  }
}

TEST_CASE("A part of no kind has the temperature of the air") {
  CHECK(part_temperature_k(BodyHeat{}, {.around = cold_night()}, 0.5) == 273);
}

TEST_CASE("What is powered is warmer than the same sheet without power, in all weather alike") {
  for (const double air_k : {253.0, 273.0, 293.0}) {
    const BodyMoment moment = {.around = night(air_k, 1.0, air_k - 6)};
    const double cold_k = part_temperature_k(Sheet{}, moment, 0.5);
    CHECK_THAT(part_temperature_k(Powered{.excess_k = 32}, moment, 0.5), WithinAbs(cold_k + 32, 1e-9));
  }
}

TEST_CASE("At night a direction is no more than its slope") {
  for (const BodyHeat& heat : all_kinds()) {
    const BodyMoment moment = {.around = cold_night()};
    CHECK_THAT(part_temperature_k(heat, moment, EastNorthUp{0, 0.8, 0.6}),
               WithinAbs(part_temperature_k(heat, moment, 0.6), 1e-9));
  }
}

TEST_CASE("Parts outside of their domain are refused by what they are") {
  CHECK(message_of<ConfigError>([] {
          validate(Clothing{.warm_clo = {-1, 1}}, "torso");
        }) == "torso.warm_clo[0] = -1 clo; expected 0 to 20 clo");
  CHECK(message_of<ConfigError>([] { validate(Unheated{.surface = {.albedo = 2}}, "rifle"); }) ==
        "rifle.albedo = 2; expected 0 to 1");
  CHECK(message_of<ConfigError>([] { validate(EngineWarmed{.warmth = {.driving_k = -1}}, "hood"); }) ==
        "hood.driving_k = -1 K; expected 0 to 900 K");
  CHECK(message_of<ConfigError>([] { validate(Powered{.excess_k = 901}, "lamp"); }) ==
        "lamp.excess_k = 901 K; expected 0 to 900 K");
  for (const BodyHeat& heat : all_kinds()) CHECK_NOTHROW(validate(heat, "part"));
}

}  // namespace body_heat_test
