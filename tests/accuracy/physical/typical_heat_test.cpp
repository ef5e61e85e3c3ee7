#include "imaging/typical_heat.h"

#include <algorithm>
#include <cmath>

#include "accuracy/physical/assets.h"
#include "heat/surface/heat_of_day.h"
#include "support/catch.h"

namespace typical_heat_test {

using namespace thermal;

namespace {

SceneOutline::Conditions conditions_of(const std::vector<const char*>& names, double crowns, double water) {
  std::vector<SceneOutline::Cover> covers = {{&material("acacia"), crowns}, {&material("water"), water}};
  for (const char* name : names) covers.push_back({&material(name), 0.1});
  SceneOutline::Conditions viewing = {.weather = weather_of(Season::winter), .view_directions = {}};
  heat_conditions(covers, materials(), viewing);
  return viewing;
}

}  // namespace

TEST_CASE("Places of the ground are those that the tables of a day give, and their shares fill the ground") {
  const SceneOutline::Conditions viewing = conditions_of({"soil", "grass"}, 0.2, 0.1);
  const HeatOfDay day(viewing.weather.day, heat_of_materials(materials()));
  const HeatOfMoment moment = day.at(viewing.weather.solar_h, {"soil", "grass"});
  for (const char* name : {"soil", "grass"}) {
    CAPTURE(name);
    const auto& places = viewing.by_exposure.at(name);
    REQUIRE(places.size() == 4);
    double shares = 0;
    for (const auto& place : places) shares += place.share;
    CHECK_THAT(shares, WithinAbs(1, 1e-12));
    CHECK(places[0].shift_k == 0);
    // At nodes of sky view and moisture the tables are exact, elsewhere within their own error at night, 0.1 K.
    const MaterialMoment& table = moment.materials.at(name);
    const double open_k = table.temperature_k({.moisture = moment.ground_moisture});
    const SurfaceExposure beside = {.sky_view = 0.75, .sunlit = 0.7, .moisture = moment.ground_moisture};
    const SurfaceExposure below = {.sky_view = 0.3, .sunlit = 0.35, .moisture = moment.ground_moisture};
    CHECK_THAT(places[1].shift_k, WithinAbs(table.temperature_k(beside) - open_k, 0.1));
    CHECK_THAT(places[2].shift_k, WithinAbs(table.temperature_k(below) - open_k, 0.1));
    CHECK(places[2].shift_k > 1);  // below crowns it is warmer at night
  }
}

TEST_CASE("Tops of crowns are colder than their middle at night, and still water is alike everywhere") {
  const SceneOutline::Conditions viewing = conditions_of({"soil"}, 0.2, 0.1);
  const auto& depths = viewing.by_exposure.at("acacia");
  CHECK(depths.front().shift_k < -0.1);
  CHECK(std::ranges::is_sorted(depths, {}, &SceneOutline::ExposureShift::shift_k));
  CHECK_FALSE(viewing.by_exposure.contains("water"));
  CHECK_FALSE(viewing.facing.contains("water"));
}

TEST_CASE("Bodies face the cold sky or their surroundings, and a camp fire warms the ground beside it") {
  const SceneOutline::Conditions viewing = conditions_of({"soil", "human", "rock", "fire"}, 0, 0);
  CHECK(viewing.facing.at("human").front().shift_k < 0);
  CHECK(viewing.facing.at("rock").size() == 4);
  const auto& fireside = viewing.by_exposure.at("fire");
  CHECK(fireside.front().shift_k == 0);
  CHECK(fireside.back().shift_k > 5);
}

}  // namespace typical_heat_test
