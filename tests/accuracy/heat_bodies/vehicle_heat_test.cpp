#include "heat/body/vehicle_heat.h"

#include "accuracy/heat_bodies/nights.h"
#include "base/error.h"
#include "heat/surface/surface_day.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace vehicle_heat_test {

using namespace thermal;

namespace {

const EngineWarmth kHood = {
    .driving_k = 20, .idling_k = 25, .parked_k = 30, .soak_s = 300, .cooling_s = 3600, .warming_s = 600};
const EngineWarmth kExhaust = {
    .driving_k = 250, .idling_k = 60, .parked_k = 340, .soak_s = 45, .cooling_s = 600, .warming_s = 120};

double parked_k(const EngineWarmth& warmth, double since_s) { return warmth_k(warmth, {.since_s = since_s}); }

}  // namespace

TEST_CASE("A part keeps its warmth when the vehicle stops") {
  CHECK_THAT(parked_k(kHood, 0), WithinAbs(20, 1e-12));
  CHECK_THAT(warmth_k(kHood, {.engine = EngineState::driving, .since_s = 1e6}), WithinAbs(20, 1e-12));
  CHECK(warmth_k(kHood, {.engine = EngineState::driving, .since_s = 0}) == 0);
  CHECK_THAT(warmth_k(kHood, {.engine = EngineState::idling, .since_s = 1e6}), WithinAbs(25, 1e-12));
  CHECK_THAT(warmth_k(kHood, {.since_s = 0, .from_cold = 0.5}), WithinAbs(10, 1e-12));
}

TEST_CASE("A hood is warmest a few minutes after stopping and cold after a night") {
  CHECK(parked_k(kHood, 600) > parked_k(kHood, 0) + 3);
  CHECK(parked_k(kHood, 600) > parked_k(kHood, 3600));
  CHECK(parked_k(kHood, 10 * 3600) < 0.01);
}

TEST_CASE("An exhaust peaks 1 to 2 min after stopping and is below 533 K within 12 min") {
  double hottest = 0;
  double when_s = 0;
  for (double since_s = 0; since_s <= 1200; since_s += 5) {
    if (parked_k(kExhaust, since_s) <= hottest) continue;
    hottest = parked_k(kExhaust, since_s);
    when_s = since_s;
  }
  CHECK(when_s >= 30);
  CHECK(when_s <= 120);
  CHECK(293 + parked_k(kExhaust, 180) > 533);
  CHECK(293 + parked_k(kExhaust, 720) < 533);
}

TEST_CASE("Coolant that cools from 366 K to 300 K in 7 h in air of 293 K has a time of 3 h") {
  const EngineWarmth coolant = {
      .driving_k = 73, .idling_k = 73, .parked_k = 73, .soak_s = 1, .cooling_s = 10750};
  CHECK_THAT(293 + parked_k(coolant, 7 * 3600.0), WithinAbs(300, 0.1));
}

TEST_CASE("A sheet is below the air on a clear night, most where it faces the sky") {
  const Sheet sheet;
  const Surroundings around = cold_night();
  const auto at = [&](double up) { return sheet_k(sheet, around.forcing, incoming_on_slope(around, up)); };
  CHECK(at(1) < 273 - 3);
  CHECK(at(1) < at(0));
  CHECK(at(0) < at(-1));
  CHECK(at(-1) < 273);
}

TEST_CASE("The roof's temperature sets a sheet's level, and the balance its slopes") {
  const Sheet sheet;
  const Surroundings around = cold_night();
  const Incoming level = incoming_on_slope(around, 1);
  const Incoming side = incoming_on_slope(around, 0);
  CHECK(sheet_k(sheet, around, 270.0, level) == 270);
  CHECK_THAT(sheet_k(sheet, around, 270.0, side) - 270,
             WithinAbs(sheet_k(sheet, around, {}, side) - sheet_k(sheet, around, {}, level), 1e-9));
}

TEST_CASE("A sheet's balance is a slab of little heat on a steady night") {
  // A day of one forcing: nothing to store.
  const Surroundings around = cold_night();
  const std::vector<Forcing> day(96, around.forcing);
  const Sheet sheet;
  const SurfaceDay slab = day_of_slab(
      {.surface = sheet.surface, .heat_capacity_j_m2_k = 3000, .behind_w_m2_k = sheet.behind_w_m2_k}, {},
      {.forcing = day}, {.per_day = 96, .layers = {}});
  CHECK_THAT(sheet_k(sheet, around.forcing, incoming_on_slope(around, 1)),
             WithinAbs(slab.surface_k.back(), 1e-6));
}

TEST_CASE("Vehicles outside of their domain are refused") {
  CHECK(message_of<ConfigError>([] { EngineWarmth{.soak_s = 4000}.validate("hood"); }) ==
        "hood.soak_s = 4000 s; expected below hood.cooling_s, 3600 s");
  CHECK(message_of<ConfigError>([] { VehicleState{.since_s = -1}.validate("vehicle"); }) ==
        "vehicle.since_s = -1 s; expected 0 to 10000000000 s");
  CHECK(message_of<ConfigError>([] { Sheet{.behind_w_m2_k = -1}.validate("roof"); }) ==
        "roof.behind_w_m2_k = -1 W/(m^2 K); expected 0 to 1000 W/(m^2 K)");
}

}  // namespace vehicle_heat_test
