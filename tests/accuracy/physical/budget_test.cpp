#include "imaging/budget.h"

#include <cmath>

#include "accuracy/physical/assets.h"
#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace budget_test {

using namespace thermal;

namespace {

const SpectralResponse kBand = SpectralResponse::flat(8, 14);
const Weather kWinter = weather_of(Season::winter);
const Weather kSummer = weather_of(Season::summer);

/// One night's values for a material [mK].
struct Shifts {
  double sky;
  double path_61m;
  double path_122m;
};

struct PublishedRow {
  const char* material;
  Shifts winter;
  Shifts summer;
};

/// Diffuse level surfaces, air at 273 K and 60 % in winter, 293 K and 70 % in summer, flat 8 to 14 um, rounded to
/// whole mK. Sky: computed with 60 digits from the formulas of atmosphere.h. Path: computed independently from those
/// and the tables of spectral_air.cpp, by the trapezoid rule in steps of 1 nm; 8 to 14 um transmits more than the
/// published 7.5 to 14 um.
constexpr PublishedRow kPublished[] = {{"soil", {1601, -35, -49}, {3284, 288, 425}},
                                       {"grass", {806, 35, 49}, {1497, 46, 68}},
                                       {"human", {232, -377, -532}, {490, -285, -420}},
                                       {"elephant", {641, -316, -447}, {1360, -144, -213}},
                                       {"truck", {4214, 179, 252}, {7702, 231, 340}}};

void check_night(const Material& material, const Weather& weather, const Shifts& expected) {
  const MaterialShift near = shift_of(material, {.weather = weather, .view_directions = {}}, 61, kBand);
  const MaterialShift far = shift_of(material, {.weather = weather, .view_directions = {}}, 122, kBand);
  CAPTURE(material.name, weather.air.temperature_k);
  // To the printed digit: half a mK.
  CHECK_THAT(1e3 * near.sky_k, WithinAbs(expected.sky, 0.5));
  CHECK_THAT(1e3 * near.path_k, WithinAbs(expected.path_61m, 0.5));
  CHECK_THAT(1e3 * far.path_k, WithinAbs(expected.path_122m, 0.5));
  CHECK(far.sky_k == near.sky_k);
}

Material made_of(const std::string& name, double emissivity) {
  Material result;
  result.name = name;
  result.emissivity = emissivity;
  result.winter_k = 278;
  result.summer_k = 288;
  return result;
}

constexpr TermChoice kAuto = TermChoice::automatic;
constexpr TermChoices kAllAuto = [] {
  TermChoices choices;
  for (const TermInfo& term : kTerms) choices.*term.choice = kAuto;
  return choices;
}();

/// Soil, grass and a person seen from straight above at a distance in a winter night.
SceneOutline savanna_from(double range_m) {
  SceneOutline outline;
  outline.covers = {
      {&material("soil"), 0.5, false}, {&material("grass"), 0.4, false}, {&material("human"), 0.1, true}};
  outline.conditions = {{.weather = kWinter, .view_directions = {{range_m, 1, 1}}}};
  return outline;
}

const TermEffect& effect(const Budget& budget, const std::string& name) {
  for (const TermEffect& one : budget.effects) {
    if (one.name == name) return one;
  }
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("Shifts of apparent temperature match the published ones, in every row, to the printed mK") {
  for (const PublishedRow& row : kPublished) {
    check_night(material(row.material), kWinter, row.winter);
    check_night(material(row.material), kSummer, row.summer);
  }
}

TEST_CASE("The budget has one line per term, in order") {
  const Budget budget = weigh_terms(savanna_from(61), kAllAuto);
  REQUIRE(budget.effects.size() == std::size(kTerms));
  for (std::size_t i = 0; i < std::size(kTerms); ++i) {
    CHECK(budget.effects[i].name == kTerms[i].name);
    CHECK(budget.effects[i].kept == budget.kept.*kTerms[i].kept);
  }
}

TEST_CASE("The air is dropped for a tripod 5 m away and kept for a drone at 61 m") {
  // Three materials: the spread from the 5th to the 95th percentile is between the most different of them. At 61 m
  // that is grass against person, 35 + 377 mK by the table above, on top of the sky's reflection there.
  const Budget drone = weigh_terms(savanna_from(61), kAllAuto);
  CHECK(drone.kept.path);
  CHECK_THAT(1e3 * effect(drone, "path").spread_k, WithinAbs(35 + 377, 1));
  CHECK_THAT(1e3 * effect(drone, "path").actor_shift_k, WithinAbs(377, 0.5));

  // A view of ground alone: soil and grass differ by 70 mK at 61 m, and by a tenth of that at 5 m.
  SceneOutline ground = savanna_from(5);
  ground.covers.pop_back();
  const Budget tripod = weigh_terms(ground, kAllAuto);
  CHECK_FALSE(tripod.kept.path);
  CHECK(effect(tripod, "path").spread_k < ground.netd_k / 3);
  ground.conditions[0].view_directions[0].range_m = 61;
  CHECK(weigh_terms(ground, kAllAuto).kept.path);
}

TEST_CASE("Other surfaces reflect sky, blackbodies do not") {
  const Material black = made_of("soot", 1);
  const Material other = made_of("lamp black", 1);
  const Material grey = made_of("rock", 0.9);
  SceneOutline outline;
  outline.conditions = {{.weather = kWinter, .view_directions = {{61, 1, 1}}}};
  outline.covers = {{&black, 0.5, false}, {&other, 0.5, false}};
  const Budget of_black = weigh_terms(outline, kAllAuto);
  CHECK_FALSE(of_black.kept.sky);
  CHECK_THAT(effect(of_black, "sky").spread_k, WithinAbs(0, 1e-9));  // the inverse's accuracy
  outline.covers[1].material = &grey;
  CHECK(weigh_terms(outline, kAllAuto).kept.sky);
}

TEST_CASE("A uniform shift is dropped, because a detector sees contrast") {
  SceneOutline outline = savanna_from(61);
  outline.covers = {{&material("truck"), 1, false}};
  const Budget budget = weigh_terms(outline, kAllAuto);
  CHECK(effect(budget, "sky").spread_k == 0);
  CHECK_FALSE(budget.kept.sky);
  CHECK_FALSE(budget.kept.path);
}

TEST_CASE("On and off override the rule") {
  TermChoices choices = kAllAuto;
  choices.path = TermChoice::off;
  choices.falloff = TermChoice::on;
  const Budget budget = weigh_terms(savanna_from(61), choices);
  CHECK_FALSE(budget.kept.path);
  CHECK(budget.kept.falloff);
  CHECK(effect(budget, "path").choice == TermChoice::off);
  CHECK(effect(budget, "falloff").spread_k == 0);  // a single direction: nothing differs
  const Budget none = weigh_terms(savanna_from(61), TermChoices());
  CHECK(none.kept == Terms());
}

TEST_CASE("An impossible term is dropped, reported, and counted among the dropped terms") {
  SceneOutline outline = savanna_from(61);
  outline.impossible = {{"path", "clip one: no depth"}};
  const Budget budget = weigh_terms(outline, kAllAuto);
  CHECK_FALSE(budget.kept.path);
  CHECK(effect(budget, "path").impossible == "clip one: no depth");
  CHECK(effect(budget, "sky").impossible.empty());
  CHECK(budget.kept.sky);
  CHECK_THAT(budget.dropped_k - weigh_terms(savanna_from(61), kAllAuto).dropped_k,
             WithinRel(effect(budget, "path").spread_k, 1e-12));  // a sum of six in another order
}

TEST_CASE("An impossible term is an error if switched on, and none if switched off") {
  SceneOutline outline = savanna_from(61);
  outline.impossible = {{"path", "clip one: no depth"}};
  TermChoices choices = kAllAuto;
  choices.path = TermChoice::on;
  CHECK(message_of<ConfigError>([&] { (void)weigh_terms(outline, choices); }) ==
        "terms.path = on; expected off or auto, because clip one: no depth");
  choices.path = TermChoice::off;
  CHECK_NOTHROW(weigh_terms(outline, choices));
}

TEST_CASE("With unknown viewing directions, terms that depend on them have no effect") {
  SceneOutline outline = savanna_from(61);
  outline.conditions[0].view_directions.clear();
  const Budget budget = weigh_terms(outline, kAllAuto);
  CHECK(effect(budget, "path").spread_k == 0);
  CHECK(effect(budget, "sky").spread_k == 0);
  CHECK(effect(budget, "falloff").spread_k == 0);
  CHECK(budget.kept.variation);
  CHECK(budget.kept.parts);
}

TEST_CASE("The total of what was dropped is the sum of the dropped lines") {
  for (const double range_m : {5.0, 61.0}) {
    TermChoices choices = kAllAuto;
    choices.sky = TermChoice::off;
    const Budget budget = weigh_terms(savanna_from(range_m), choices);
    double sum_k = 0;
    for (const TermEffect& one : budget.effects) sum_k += one.kept ? 0 : one.spread_k;
    CHECK(budget.dropped_k == sum_k);
    CHECK(budget.dropped_k >= effect(budget, "sky").spread_k);
  }
}

TEST_CASE("A term is kept if its spread exceeds a third of the NETD") {
  SceneOutline outline = savanna_from(61);
  const double spread_k = effect(weigh_terms(outline, kAllAuto), "path").spread_k;
  outline.netd_k = 3 * spread_k * 0.999;
  CHECK(weigh_terms(outline, kAllAuto).kept.path);
  outline.netd_k = 3 * spread_k * 1.001;
  CHECK_FALSE(weigh_terms(outline, kAllAuto).kept.path);
}

TEST_CASE("The worst of several nights decides for all frames") {
  SceneOutline outline = savanna_from(5);
  outline.covers.pop_back();
  const double near_k = effect(weigh_terms(outline, kAllAuto), "path").spread_k;
  outline.conditions.push_back({.weather = kSummer, .view_directions = {{122, 1, 1}}});
  const Budget both = weigh_terms(outline, kAllAuto);
  // Soil against grass in summer, by the table: 425 - 68 mK.
  CHECK_THAT(1e3 * effect(both, "path").spread_k, WithinAbs(425 - 68, 1));
  CHECK(near_k < outline.netd_k / 3);
  CHECK(both.kept.path);
}

TEST_CASE("Angles matter for water seen at several angles, not for plants") {
  SceneOutline outline;
  outline.conditions = {{.weather = kWinter, .view_directions = {{61, 1, 1}, {80, 0.7, 1}, {120, 0.4, 1}}}};
  outline.covers = {{&material("water"), 1, false}};
  CHECK(weigh_terms(outline, kAllAuto).kept.angular);
  outline.covers = {{&material("grass"), 1, false}};
  CHECK(effect(weigh_terms(outline, kAllAuto), "angular").spread_k == 0);
}

TEST_CASE("What water mirrors counts where there is water, seen at a slant, under a reflected sky") {
  SceneOutline outline = savanna_from(61);
  outline.conditions[0].view_directions = {{122, 0.5, 1}};
  const Budget dry = weigh_terms(outline, kAllAuto);
  CHECK(effect(dry, "mirror").spread_k == 0);
  CHECK_FALSE(dry.kept.mirror);

  outline.covers.push_back({&material("water"), 0.05, false});
  const Budget wet = weigh_terms(outline, kAllAuto);
  CHECK(wet.kept.mirror);
  // At 30 deg above the horizon, 4 m high things reach 6.9 m: 2 x 6.9 / (50 pi) = 8.8 % of the water mirror them.
  // They hide a sky of emissivity .41; soil at 278 K and grass at 273 K, which reflect some sky, radiate .97 to 1.06
  // of what air at 273 K does. At 60 deg Table 1's water reflects 1 - .96 x .95 = .09 of the difference, at 55 K per
  // share of radiance: 2.7 to 3.2 K.
  CHECK(effect(wet, "mirror").spread_k > 2.7);
  CHECK(effect(wet, "mirror").spread_k < 3.2);

  // Straight down, water mirrors the sky alone.
  outline.conditions[0].view_directions = {{61, 1, 1}};
  CHECK(effect(weigh_terms(outline, kAllAuto), "mirror").spread_k == 0);
}

TEST_CASE("Nothing is mirrored without the sky's reflection") {
  SceneOutline outline = savanna_from(61);
  outline.conditions[0].view_directions = {{122, 0.5, 1}};
  TermChoices choices = kAllAuto;
  choices.sky = TermChoice::off;
  CHECK(effect(weigh_terms(outline, choices), "mirror").impossible.empty());
  outline.covers.push_back({&material("water"), 0.05, false});
  CHECK(effect(weigh_terms(outline, choices), "mirror").impossible == "the term sky is off");
  choices.mirror = TermChoice::on;
  CHECK(message_of<ConfigError>([&] { (void)weigh_terms(outline, choices); }) ==
        "terms.mirror = on; expected off or auto, because the term sky is off");
}

TEST_CASE("Fall-off is measured by its effect on noise: cos^-4 of the NETD towards the corners") {
  SceneOutline outline = savanna_from(61);
  outline.conditions[0].view_directions = {{61, 1, 1}, {64, 0.95, std::cos(22.5 * 3.14159265358979 / 180)}};
  const Budget budget = weigh_terms(outline, kAllAuto);
  // cos^4 of 22.5 deg is .729 to the printed digits: noise is 1 / .729 - 1 = .372 of the NETD higher.
  CHECK_THAT(effect(budget, "falloff").spread_k / outline.netd_k, WithinAbs(0.372, 0.001));
  CHECK(budget.kept.falloff);
}

TEST_CASE("Variation spreads by 3.3 standard deviations, as a normal distribution does from 5 % to 95 %") {
  SceneOutline outline;
  outline.conditions = {{.weather = kWinter, .view_directions = {{61, 1, 1}}}};
  outline.covers = {{&material("soil"), 1, false}};
  // Of ten equal weights the lowest and the highest hold 5 % at their middles: 2 * 1.645 standard deviations.
  const double stddev_k = material("soil").variation.stddev_k;
  CHECK_THAT(effect(weigh_terms(outline, kAllAuto), "variation").spread_k,
             WithinRel(2 * 1.645 * stddev_k, 1e-3));
}

TEST_CASE("Parts are measured over actors only") {
  const Budget budget = weigh_terms(savanna_from(61), kAllAuto);
  // A face at 1.45 times the person's excess of 19 K over the air, against a pack at .15: more than 20 K
  // apart.
  CHECK(effect(budget, "parts").spread_k > 20);
  CHECK(budget.kept.parts);
  SceneOutline empty = savanna_from(61);
  empty.covers.pop_back();
  CHECK(effect(weigh_terms(empty, kAllAuto), "parts").spread_k == 0);
}

TEST_CASE("What places do to the ground counts by how much of the pictures lies there") {
  SceneOutline outline = savanna_from(61);
  // Nine tenths of the soil, half of the pictures, lie open; grass does not care: 5 % at 4 K, and none at more.
  outline.conditions.front().by_exposure["soil"] = {{0, 0.88}, {4, 0.12}};
  CHECK(effect(weigh_terms(outline, kAllAuto), "place").spread_k == 4);
  outline.conditions.front().by_exposure["soil"] = {{0, 0.98}, {4, 0.02}};
  const Budget level = weigh_terms(outline, kAllAuto);
  CHECK(effect(level, "place").spread_k == 0);
  CHECK_FALSE(level.kept.place);
  CHECK_FALSE(level.kept.facing);
}

TEST_CASE("The sides of actors count beside all else, however small actors are") {
  SceneOutline outline = savanna_from(61);
  outline.conditions.front().facing["soil"] = {{-0.1, 0.5}, {0.1, 0.5}};
  CHECK_THAT(effect(weigh_terms(outline, kAllAuto), "facing").spread_k, WithinAbs(0.2, 1e-12));
  outline.conditions.front().facing["human"] = {{-1.5, 0.5}, {1, 0.5}};
  const Budget budget = weigh_terms(outline, kAllAuto);
  CHECK(effect(budget, "facing").spread_k == 2.5);
  CHECK(effect(budget, "facing").actor_shift_k == 1.5);
  CHECK(budget.kept.facing);
}

TEST_CASE("Smear counts with the motion within a time constant, up to the whole contrast of an actor") {
  SceneOutline outline = savanna_from(61);
  const auto smear_of = [&](double smear_px) {
    outline.smear_px = smear_px;
    return effect(weigh_terms(outline, kAllAuto), "smear");
  };
  CHECK(smear_of(0).spread_k == 0);
  CHECK_FALSE(smear_of(0).kept);
  const TermEffect whole = smear_of(1);
  CHECK(whole.kept);
  CHECK(whole.actor_shift_k > 5);                // a person on cold ground
  CHECK(whole.spread_k == whole.actor_shift_k);  // once, not to either side
  CHECK(smear_of(30).spread_k == whole.spread_k);
  CHECK_THAT(smear_of(0.5).spread_k, WithinAbs(whole.spread_k / 2, 1e-12));
  CHECK_FALSE(smear_of(1e-5).kept);
}

}  // namespace budget_test
