#include "heat/body/fire.h"

#include <limits>

#include "accuracy/heat_bodies/nights.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace fire_test {

using namespace thermal;

TEST_CASE("A camp fire of 0.6 m has tens of kilowatts and flames as high as it is wide") {
  const CampFire fire;
  CHECK(fire_power_w(fire) > 3e4);
  CHECK(fire_power_w(fire) < 1e5);
  CHECK(flame_height_m(fire) > 0.4);
  CHECK(flame_height_m(fire) < 1.2);
  CHECK(flame_emissivity(fire) > 0.3);
  CHECK(flame_emissivity(fire) < 0.5);
  CHECK(bed_mean_k(fire) > 800);
  CHECK(bed_mean_k(fire) < 1000);
  CHECK(flame_height_m({.diameter_m = 5, .burn_rate_kg_m2_s = 0.001}) == 0);
}

TEST_CASE("Over a wide floor the ground gets the half of the radiation that goes down") {
  const CampFire fire;
  double sum_w = 0;
  constexpr double kStepM = 0.001;
  for (double r = kStepM / 2; r < 400; r += kStepM) {
    sum_w += 2 * 3.14159265358979 * r * kStepM * fire_irradiance_w_m2(fire, r);
  }
  // Within the bed it is taken as at its edge, which is less than below the flames.
  CHECK(sum_w < 0.5 * fire.radiant_share * fire_power_w(fire));
  CHECK(sum_w > 0.3 * fire.radiant_share * fire_power_w(fire));
  CHECK(fire_irradiance_w_m2(fire, 0) == fire_irradiance_w_m2(fire, 0.3));
}

TEST_CASE("Ground beside a fire is warm, and as without it far away") {
  const CampFire fire;
  const GroundProperties ground;
  const Surroundings around = cold_night();
  double before = 1000;
  for (const double distance_m : {0.4, 0.6, 1.0, 1.5, 2.0, 4.0, 10.0}) {
    const double t = fireside_ground_k(fire, around, ground, 268, distance_m);
    CHECK(t < before);
    CHECK(t > 268);
    before = t;
  }
  CHECK_THAT(fireside_ground_k(fire, around, ground, 268, 1000), WithinAbs(268, 1e-3));
  CHECK(fireside_ground_k(fire, around, ground, 268, 1.0) > 290);
  CampFire steady = fire;
  steady.burning_s = std::numeric_limits<double>::infinity();
  CHECK(fireside_ground_k(steady, around, ground, 268, 1.0) >
        fireside_ground_k(fire, around, ground, 268, 1.0));
}

TEST_CASE("An ash bed cools from the burning bed to the ground within a day") {
  const CampFire fire;
  const GroundProperties ground;
  const Surroundings around = cold_night();
  CHECK_THAT(ash_bed_k(fire, around, ground, 268, 0), WithinAbs(bed_mean_k(fire), 0.1));
  double before = 2000;
  for (const double hours : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 24.0}) {
    const double t = ash_bed_k(fire, around, ground, 268, hours * 3600);
    CHECK(t < before);
    CHECK(t > 268);
    before = t;
  }
  CHECK(before < 275);
}

TEST_CASE("Fires outside of their domain are refused") {
  CHECK(message_of<ConfigError>([] { CampFire{.diameter_m = 0}.validate("fire"); }) ==
        "fire.diameter_m = 0 m; expected 0.1 to 5 m");
  CHECK(message_of<ConfigError>([] { CampFire{.ember_k = 300}.validate("fire"); }) ==
        "fire.ember_k = 300 K; expected 600 to 1400 K");
}

}  // namespace fire_test
