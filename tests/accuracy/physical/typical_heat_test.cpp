#include "imaging/typical_heat.h"

#include <algorithm>
#include <cmath>

#include "accuracy/physical/assets.h"
#include "heat/surface/heat_of_day.h"
#include "support/catch.h"

namespace typical_heat_test {

using namespace thermal;

namespace {

SceneOutline::Night night_of(const std::vector<const char*>& names, double crowns, double water) {
  std::vector<SceneOutline::Cover> covers = {{&material("acacia"), crowns}, {&material("water"), water}};
  for (const char* name : names) covers.push_back({&material(name), 0.1});
  SceneOutline::Night night = {.weather = weather_of(Season::winter), .looks = {}};
  heat_night(covers, materials(), night);
  return night;
}

}  // namespace

TEST_CASE("Places of the ground are those that the tables of a day give, and their shares fill the ground") {
  const SceneOutline::Night night = night_of({"soil", "grass"}, 0.2, 0.1);
  const HeatOfDay day(night.weather.day, heat_of_materials(materials()));
  const HeatOfMoment moment = day.at(night.weather.solar_h, {"soil", "grass"});
  for (const char* name : {"soil", "grass"}) {
    CAPTURE(name);
    const auto& places = night.by_place.at(name);
    REQUIRE(places.size() == 4);
    double shares = 0;
    for (const auto& place : places) shares += place.share;
    CHECK_THAT(shares, WithinAbs(1, 1e-12));
    CHECK(places[0].shift_k == 0);
    // At nodes of sky view and moisture the tables are exact, elsewhere within their own error at night, 0.1 K.
    const MaterialMoment& table = moment.materials.at(name);
    const double open_k = table.temperature_k({.moisture = moment.ground_moisture});
    const SurfacePlace beside = {.sky_view = 0.75, .sunlit = 0.7, .moisture = moment.ground_moisture};
    const SurfacePlace below = {.sky_view = 0.3, .sunlit = 0.35, .moisture = moment.ground_moisture};
    CHECK_THAT(places[1].shift_k, WithinAbs(table.temperature_k(beside) - open_k, 0.1));
    CHECK_THAT(places[2].shift_k, WithinAbs(table.temperature_k(below) - open_k, 0.1));
    CHECK(places[2].shift_k > 1);  // below crowns it is warmer at night
  }
}

TEST_CASE("Tops of crowns are colder than their middle at night, and still water is alike everywhere") {
  const SceneOutline::Night night = night_of({"soil"}, 0.2, 0.1);
  const auto& depths = night.by_place.at("acacia");
  CHECK(depths.front().shift_k < -0.1);
  CHECK(std::ranges::is_sorted(depths, {}, &SceneOutline::PlaceShift::shift_k));
  CHECK_FALSE(night.by_place.contains("water"));
  CHECK_FALSE(night.facing.contains("water"));
}

TEST_CASE("Bodies face the cold sky or their surroundings, and a camp fire warms the ground beside it") {
  const SceneOutline::Night night = night_of({"soil", "human", "rock", "fire"}, 0, 0);
  CHECK(night.facing.at("human").front().shift_k < 0);
  CHECK(night.facing.at("rock").size() == 4);
  const auto& fireside = night.by_place.at("fire");
  CHECK(fireside.front().shift_k == 0);
  CHECK(fireside.back().shift_k > 5);
}

}  // namespace typical_heat_test
