#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "accuracy/heat_bodies/nights.h"
#include "accuracy/physical/assets.h"
#include "base/error.h"
#include "heat/body/body_heat.h"
#include "heat/surface/heat_of_day.h"
#include "heat/weather/air_profile.h"
#include "io/config/materials.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace material_heat_test {

using namespace thermal;

namespace {

/// Temperature of the side of a part.
double side_k(const std::string& material_name, const std::string& part, const BodyMoment& moment) {
  const BodyHeat* heat = material(material_name).body_heat_of(part);
  REQUIRE(heat != nullptr);
  return part_temperature_k(*heat, moment, 0.0);
}

std::string message_for(const char* text) {
  return message_of<ConfigError>([&] { (void)read_body_heat(Json::parse(text), "torso.heat"); });
}

}  // namespace

TEST_CASE("Every material but the sky, and every part, states in one way what heats it") {
  for (const auto& [name, one] : materials().all()) {
    CAPTURE(name);
    CHECK((one.body_heat.has_value() != one.heat.has_value()) == (name != "sky"));
    for (const auto& [part, values] : one.parts) {
      CAPTURE(part);
      CHECK(values.body_heat.has_value() != values.heat.has_value());
    }
  }
}

TEST_CASE("What heats a body is stated for every actor") {
  for (const char* actor : {"crocodile", "elephant", "fire", "giraffe", "human", "impala", "truck"})
    CHECK(material(actor).body_heat_of("") != nullptr);
}

TEST_CASE("By Table 1, wood is as warm as its tree; what states no heat of its own follows the whole") {
  for (const char* tree : {"acacia", "hookthorn"}) {
    const Material& one = material(tree);
    for (const Season season : {Season::winter, Season::summer})
      CHECK(one.part_temperature_k("wood", weather_of(season)) ==
            one.part_temperature_k("", weather_of(season)));
    CHECK(one.heat_name("wood") == one.name + " wood");
    CHECK(one.heat_name("") == one.name);
    CHECK(std::holds_alternative<GroundHeat>(*one.heat_of("wood")));
    CHECK(one.heat_of("bark") == one.heat_of(""));
  }
  CHECK(material("baobab").heat_name("wood") == "baobab");
  CHECK(material("elephant").heat_of("torso") == nullptr);
}

TEST_CASE(
    "After sunset stems stay warmer than leaves, thick ones until the morning; so do baobabs and mounds") {
  // Sides of stems, as a camera on a drone sees them, below crowns that leave 0.6 of sky and sun; means of all azimuths.
  const auto side_of = [](const HeatOfMoment& moment, const std::string& name, double open) {
    double sum_k = 0;
    for (const EastNorthUp& normal : {EastNorthUp{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}})
      sum_k += moment.materials.at(name).temperature_k({.normal = normal, .sky_view = open, .sunlit = open});
    return sum_k / 4;
  };
  std::map<std::string, MaterialHeat> heat;
  for (const char* name : {"soil", "acacia", "hookthorn", "baobab", "log", "termite_mound"}) {
    const Material& one = material(name);
    heat.emplace(name, *one.heat_of(""));
    if (one.parts.contains("wood")) heat.emplace(one.heat_name("wood"), *one.heat_of("wood"));
  }
  std::set<std::string> names;
  for (const auto& entry : heat) names.insert(entry.first);
  for (const Season season : {Season::winter, Season::summer}) {
    const HeatOfDay day(weather_of(season).day, heat);
    const auto above_leaves_k = [&](const char* name, double open, double solar_h) {
      const HeatOfMoment moment = day.at(solar_h, names);
      // Stems are computed in the air of 2 m, leaves in that of their height.
      const double warmer_k = StableAir(moment.forcing, moment.ground_k).warmer_k(5);
      const double leaves_k = moment.materials.at("acacia").temperature_k({.sky_view = 0.6}) - warmer_k;
      return side_of(moment, name, open) - leaves_k;
    };
    for (const double solar_h : {18.5, 20.0, 22.0}) {
      CAPTURE(solar_h);
      CHECK(above_leaves_k("acacia wood", 0.6, solar_h) > 2.5);
      CHECK(above_leaves_k("hookthorn wood", 0.6, solar_h) > 2);
      CHECK(above_leaves_k("baobab", 1, solar_h) > 2);
      CHECK(above_leaves_k("termite_mound", 1, solar_h) > 2);
    }
    // Thin stems have given their warmth away by three at night, dry logs earlier.
    CHECK(above_leaves_k("acacia wood", 0.6, 3) > 1);
    CHECK(above_leaves_k("baobab", 1, 3) > above_leaves_k("log", 1, 3) + 1);
    CHECK(std::abs(above_leaves_k("hookthorn wood", 0.6, 3)) < 1);
  }
}

TEST_CASE("People, animals and vehicles have plausible temperatures in the nights of Table 1") {
  const BodyMoment cold = {.around = cold_night()};
  const BodyMoment warm = {.around = warm_night()};
  // Outer cloth at 276 to 283 K in air of 273 K is what ISO 7730 gives for calm air; this night has wind and a clear sky.
  for (const char* part : {"torso", "arms", "legs"}) {
    CAPTURE(part);
    CHECK(side_k("human", part, cold) > 275.5);
    CHECK(side_k("human", part, cold) < 283);
    CHECK(side_k("human", part, warm) > 294);
    CHECK(side_k("human", part, warm) < 299);
  }
  for (const BodyMoment& moment : {cold, warm}) {
    CHECK(side_k("human", "face", moment) > side_k("human", "hands", moment));
    CHECK(side_k("human", "hands", moment) > side_k("human", "torso", moment));
    CHECK(side_k("human", "pack", moment) < moment.around.forcing.air_k);
    CHECK(side_k("elephant", "torso", moment) > side_k("elephant", "ears", moment) + 5);
    for (const char* animal : {"zebra", "giraffe", "impala", "lion", "cattle", "goat", "dog", "warthog",
                               "buffalo", "wildebeest"}) {
      CAPTURE(animal);
      CHECK(side_k(animal, "head", moment) > side_k(animal, "", moment));
      CHECK(side_k(animal, "", moment) > side_k(animal, "legs", moment));
      CHECK(side_k(animal, "legs", moment) > side_k(animal, "tail", moment));
    }
    CHECK(side_k("cattle", "udder", moment) > side_k("cattle", "head", moment));
    CHECK(side_k("cattle", "", moment) > side_k("cattle", "hump", moment));
    CHECK(side_k("cattle", "legs", moment) > side_k("cattle", "dewlap", moment));
    CHECK(side_k("baboon", "face", moment) > side_k("baboon", "head", moment));
    CHECK(side_k("baboon", "rump", moment) > side_k("baboon", "", moment));
    CHECK(side_k("baboon", "", moment) > side_k("baboon", "mane", moment));
    CHECK(side_k("warthog", "", moment) > side_k("zebra", "", moment));  // nearly bare
    // Plumage follows the air, bare skin does not.
    CHECK_THAT(side_k("ostrich", "", moment), WithinAbs(moment.around.forcing.air_k, 2));
    CHECK(side_k("ostrich", "thighs", moment) > side_k("ostrich", "neck", moment));
    CHECK(side_k("ostrich", "neck", moment) > side_k("ostrich", "legs", moment) + 2);
    CHECK(side_k("ostrich", "legs", moment) > side_k("ostrich", "wings", moment) + 2);
  }
  CHECK_THAT(side_k("elephant", "ears", cold), WithinAbs(273, 2));
  // Skin of elephants is 27 to 37 deg C at 22:00 in the warm season.
  const double elephant_k = side_k("elephant", "torso", {.around = night(298, 1, 297)});
  CHECK(elephant_k > 300);
  CHECK(elephant_k < 310);
}

TEST_CASE(
    "Large animals give off 2 to 3 times their basal rate when they forage in the cold, and less at rest") {
  // Basal: 3.4 M^0.75 W (Kleiber, Hilgardia 6, 315, 1932: 70 kcal a day), over 0.1 M^(2/3) m^2 of skin (Meeh's form).
  // The shares of skin are estimates; "" is what has no part of its own.
  struct Animal {
    const char* name;
    double mass_kg;
    std::map<std::string, double> skin;
  };
  const Animal animals[] = {
      {"elephant", 3000, {{"torso", 0.5}, {"legs", 0.2}, {"ears", 0.2}, {"trunk", 0.1}}},
      {"hippopotamus", 1500, {{"", 0.75}, {"head", 0.15}, {"legs", 0.1}}},
      {"rhinoceros", 1200, {{"", 0.7}, {"head", 0.12}, {"legs", 0.18}}}};
  for (const Animal& animal : animals) {
    const char* const name = animal.name;
    const double basal_w_m2 =
        3.4 * std::pow(animal.mass_kg, 0.75) / (0.1 * std::pow(animal.mass_kg, 2.0 / 3));
    const auto rates = [&](Activity activity) {
      const BodyMoment moment = {.around = cold_night(), .activity = activity};
      const double rest = activity == Activity::standing ? resting_tissue_m2_k_w(273) : 0;
      double sum_w_m2 = 0;
      for (const auto& [part, share] : animal.skin) {
        const auto& coat = std::get<Coat>(*material(name).body_heat_of(part));
        const double resistance = coat.tissue.resistance_m2_k_w(273, activity) + coat.coat_m2_k_w + rest;
        sum_w_m2 += share * (coat.tissue.core_k - part_temperature_k(coat, moment, 0.0)) / resistance;
      }
      return sum_w_m2 / basal_w_m2;
    };
    CAPTURE(name, rates(Activity::walking), rates(Activity::standing));
    CHECK(rates(Activity::walking) > 2);
    CHECK(rates(Activity::walking) < 3);
    CHECK(rates(Activity::standing) > 1.4);
    CHECK(rates(Activity::standing) < 2);
  }
  BodyMoment still = {.around = cold_night()};
  BodyMoment walks = {.around = cold_night(), .activity = Activity::walking};
  // A resting elephant is 7 to 8 K colder than one that forages, animals with fur 2 to 4.5 K.
  CHECK_THAT(side_k("elephant", "torso", walks) - side_k("elephant", "torso", still), WithinAbs(7.5, 1));
  for (const char* animal : {"zebra", "cattle", "lion"}) {
    CAPTURE(animal);
    CHECK_THAT(side_k(animal, "", walks) - side_k(animal, "", still), WithinAbs(3.25, 1.25));
  }
  still.around = walks.around = night(293, 1, 291.5);
  const Coat hide = {.tissue = {.warm_m2_k_w = 0.05, .cold_m2_k_w = 0.05}};
  CHECK(part_temperature_k(hide, still, 0.0) == part_temperature_k(hide, walks, 0.0));
}

TEST_CASE("A vehicle that drives is warm, one that stands is as cold as its sheets") {
  BodyMoment moment = {.around = warm_night()};
  for (const char* part : {"hood", "tyres", "hubs", "chassis", "cabin", "windows"}) {
    CAPTURE(part);
    moment.vehicle = {.engine = EngineState::driving, .since_s = 7200};
    const double driving_k = side_k("truck", part, moment);
    moment.vehicle = {.since_s = 86400};
    const double cold_k = side_k("truck", part, moment);
    CHECK(driving_k > cold_k + 4);
    CHECK(cold_k < 293);
  }
}

TEST_CASE(
    "An exhaust is the hottest part of a vehicle that drives, stands or has just stopped; tyres tell these "
    "apart") {
  BodyMoment moment = {.around = cold_night()};
  const auto excess_k = [&](const char* part, EngineState engine, double since_s) {
    moment.vehicle = {.engine = engine, .since_s = since_s};
    const double now_k = side_k("truck", part, moment);
    moment.vehicle = {};
    return now_k - side_k("truck", part, moment);
  };
  CHECK_THAT(excess_k("exhaust", EngineState::driving, 3600), WithinAbs(110, 0.1));
  CHECK_THAT(excess_k("exhaust", EngineState::idling, 3600), WithinAbs(40, 0.1));
  CHECK(excess_k("exhaust", EngineState::parked, 60) > 110);
  CHECK(excess_k("exhaust", EngineState::parked, 3600) < 1);
  CHECK(excess_k("hood", EngineState::parked, 3600) > 8);
  for (const char* part : {"tyres", "hubs"}) {
    CHECK(excess_k(part, EngineState::driving, 3600) > 15);
    CHECK(excess_k(part, EngineState::idling, 3600) == 0);
  }
  for (const auto& [part, values] : material("truck").parts) {
    CAPTURE(part);
    if (part != "exhaust")
      CHECK(
          side_k("truck", part, {.around = cold_night(), .vehicle = {.engine = EngineState::driving}}) <
          side_k("truck", "exhaust", {.around = cold_night(), .vehicle = {.engine = EngineState::driving}}));
  }
}

TEST_CASE("A fire burns at 600 to 1200 K, and what is left of it cools for hours") {
  BodyMoment moment = {.around = cold_night()};
  moment.fire = {.fire = {.diameter_m = 0.6, .burning_s = 3600}};
  for (const char* part : {"embers", "ash", "flames"}) {
    CAPTURE(part);
    CHECK(side_k("fire", part, moment) > 600);
    CHECK(side_k("fire", part, moment) < 1200);
  }
  CHECK(side_k("fire", "embers", moment) > side_k("fire", "ash", moment));
  // 1 - exp(-0.8 x 0.6) = 0.3812 of the radiation of 1150 K.
  CHECK_THAT(side_k("fire", "flames", moment), WithinAbs(1150 * std::pow(0.38122, 0.25), 0.1));
  double before_k = 900;
  for (const double since_s : {1.0, 600.0, 3600.0, 4 * 3600.0}) {
    moment.fire.burning = false;
    moment.fire.since_s = since_s;
    const double now_k = side_k("fire", "ash", moment);
    CHECK(now_k < before_k);
    CHECK(side_k("fire", "embers", moment) == now_k);
    before_k = now_k;
  }
  CHECK(before_k > moment.around.ground_k);
  CHECK(before_k < 400);
}

TEST_CASE("Keys of other kinds and values outside of their domain are refused") {
  CHECK(message_for(R"({"kind": "skin", "coat_m2_k_w": 0.1, "source": ""})") ==
        "torso.heat.coat_m2_k_w = 0.1; expected no such key in heat of kind skin; its keys are albedo, "
        "broadband_emissivity, cold_tissue_m2_k_w, core_k, kind, open_view, source, warm_tissue_m2_k_w");
  CHECK(message_for(R"({"kind": "air", "core_k": 310, "source": ""})") ==
        "torso.heat.core_k = 310; expected no such key in heat of kind air; its keys are kind, source");
  CHECK(message_for(R"({"kind": "clothing", "cold_clo": [2, 1], "source": ""})") ==
        "torso.heat.cold_clo[1] = 1 clo; expected 2 to 20 clo");
  CHECK(message_for(R"({"kind": "sheet", "broadband_emissivity": 0, "source": ""})") ==
        "torso.heat.broadband_emissivity = 0; expected above 0 and at most 1");
}

TEST_CASE("Each kind is read with the defaults of its kind") {
  const auto read = [](const char* text) { return read_body_heat(Json::parse(text), "part"); };
  CHECK(read(R"({"kind": "air", "source": ""})") == BodyHeat{});
  CHECK(read(R"({"kind": "clothing", "source": ""})") == BodyHeat{Clothing{}});
  CHECK(read(R"({"kind": "coat", "source": ""})") == BodyHeat{Coat{}});
  CHECK(read(R"({"kind": "cold_blooded", "source": ""})") == BodyHeat{ColdBlooded{}});
  CHECK(read(R"({"kind": "unheated", "source": ""})") == BodyHeat{Unheated{}});
  CHECK(read(R"({"kind": "sheet", "source": ""})") == BodyHeat{Sheet{}});
  CHECK(read(R"({"kind": "engine", "source": ""})") == BodyHeat{EngineWarmed{}});
  CHECK(read(R"({"kind": "powered", "excess_k": 9, "source": ""})") == BodyHeat{Powered{.excess_k = 9}});
  CHECK(std::get<Coat>(read(R"({"kind": "skin", "source": ""})")).surface.diameter_m == 0);
}

}  // namespace material_heat_test
