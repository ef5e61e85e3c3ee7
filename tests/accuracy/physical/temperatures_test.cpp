#include <cmath>
#include <limits>

#include "accuracy/physical/assets.h"
#include "support/catch.h"

namespace temperatures_test {

using namespace thermal;

namespace {

/// Table 1 of Bondi et al. (COMPASS 2018): night temperatures and emissivity.
struct TableRow {
  const char* material;
  double winter_k;
  double summer_k;
  double emissivity;
};
constexpr TableRow kTable1[] = {
    {"soil", 278, 288, .914},     {"grass", 273, 293, .958},     {"shrub", 273, 293, .986},
    {"acacia", 273, 293, .952},   {"human", 292, 301, .985},     {"elephant", 290, 298, .96},
    {"zebra", 298, 307, .98},     {"rhinoceros", 291, 299, .96}, {"hippopotamus", 290, 298, .96},
    {"crocodile", 295, 303, .96}, {"water", 273, 293, .96},      {"truck", 273, 293, .80}};

Weather air_at(double temperature_k) {
  Weather weather;
  weather.air.temperature_k = temperature_k;
  return weather;
}

}  // namespace

TEST_CASE("The materials of Table 1 have its temperatures in air of 273 K and 293 K, to the bit") {
  for (const TableRow& row : kTable1) {
    CAPTURE(row.material);
    const Material& one = material(row.material);
    CHECK(one.in_table_1);
    CHECK(one.emissivity == row.emissivity);
    CHECK(one.temperature_k(273.0) == row.winter_k);
    CHECK(one.temperature_k(293.0) == row.summer_k);
    CHECK(one.temperature_k(Season::winter) == row.winter_k);
    CHECK(one.temperature_k(Season::summer) == row.summer_k);
  }
}

TEST_CASE("No other material claims to be in Table 1") {
  std::size_t claimed = 0;
  for (const auto& [name, one] : materials().all()) claimed += one.in_table_1 ? 1 : 0;
  CHECK(claimed == std::size(kTable1));
}

TEST_CASE("Temperature is linear in air temperature, between and beyond both nights") {
  for (const TableRow& row : kTable1) {
    CAPTURE(row.material);
    const double per_kelvin = (row.summer_k - row.winter_k) / 20;
    for (const double air_k : {253.0, 268.5, 283.0, 303.25}) {
      // Three operations on numbers near 300 K.
      CHECK_THAT(
          material(row.material).temperature_k(air_k),
          WithinRel(row.winter_k + per_kelvin * (air_k - 273), 4 * std::numeric_limits<double>::epsilon()));
    }
  }
}

TEST_CASE("Animals follow the air by less than half, soil by half, plants, water and steel entirely") {
  const auto rise = [](const char* name) {
    return material(name).temperature_k(284.0) - material(name).temperature_k(283.0);
  };
  const auto near = [](double expected) { return WithinAbs(expected, 1e-12); };  // differences of 300 K
  CHECK_THAT(rise("human"), near(.45));
  CHECK_THAT(rise("zebra"), near(.45));
  for (const char* name : {"elephant", "hippopotamus", "rhinoceros", "crocodile"})
    CHECK_THAT(rise(name), near(.40));
  CHECK_THAT(rise("soil"), near(.50));
  for (const char* name : {"grass", "shrub", "acacia", "water", "truck"}) CHECK_THAT(rise(name), near(1));
}

TEST_CASE("A part takes a share of the actor's excess over the air, and an offset") {
  Material actor;
  actor.winter_k = 290;
  actor.summer_k = 300;
  actor.parts["ear"] = {.excess_factor = 0.25, .offset_k = 0.5};
  // In air at 283 K the whole actor is at 295 K, 12 K above it.
  CHECK(actor.part_temperature_k("ear", air_at(283)) == 283 + 3 + 0.5);
  CHECK(actor.part_temperature_k("", air_at(283)) == 295);
  CHECK(actor.part_temperature_k("trunk", air_at(283)) == 295);
}

TEST_CASE("A face is warmer than a body, which is warmer than its clothes; ears are near the air") {
  const Weather cold = air_at(273);
  const auto person = [&](const char* part) { return material("human").part_temperature_k(part, cold); };
  CHECK(person("face") > person("hands"));
  CHECK(person("hands") > person(""));
  CHECK(person("") > person("torso"));
  CHECK(person("torso") > person("pack"));
  CHECK(person("pack") > 273);
}

TEST_CASE("A vehicle cools exponentially from the moment it stops") {
  const Material& truck = material("truck");
  const auto hood_k = [&](double stopped_s) {
    Weather weather = air_at(273);
    weather.vehicle_stopped_s = stopped_s;
    return truck.part_temperature_k("hood", weather);
  };
  const MaterialPart& hood = truck.parts.at("hood");
  const double rounding_k = 4 * 320 * std::numeric_limits<double>::epsilon();
  CHECK_THAT(hood_k(0), WithinAbs(273 + hood.cooling_excess_k, rounding_k));
  CHECK_THAT(hood_k(hood.cooling_time_s), WithinAbs(273 + hood.cooling_excess_k / std::exp(1.0), rounding_k));
  CHECK_THAT(hood_k(2 * hood.cooling_time_s),
             WithinAbs(273 + hood.cooling_excess_k / std::exp(2.0), rounding_k));
  CHECK(hood_k(1e9) == 273);
}

}  // namespace temperatures_test
