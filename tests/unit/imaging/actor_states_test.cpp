#include "imaging/actor_states.h"

#include <cmath>
#include <set>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace actor_states_test {

using namespace thermal;

namespace {

Material material(const char* name, BodyHeat whole, const std::map<std::string, MaterialPart>& parts = {}) {
  Material material;
  material.name = name;
  material.body_heat = std::move(whole);
  material.parts = parts;
  return material;
}

/// A coat, clothes, and sheets that an engine warms.
MaterialLibrary materials() {
  MaterialLibrary library;
  library.add(material("animal", Coat{}));
  library.add(material("person", Coat{}, {{"torso", {.body_heat = Clothing{}}}}));
  library.add(material("vehicle", Sheet{}, {{"hood", {.body_heat = EngineWarmed{}}}}));
  return library;
}

Weather stopped(double stopped_s) {
  Weather weather;
  weather.vehicle_stopped_s = stopped_s;
  return weather;
}

ManifestObject actor(std::uint16_t index, const char* material) {
  ManifestObject object;
  object.index = index;
  object.name = "one";
  object.object_class = ObjectClass::actor;
  object.material = material;
  return object;
}

/// Two frames, at 100 s and 300 s of the scene, in which actor 101 moves.
Manifest scene(std::vector<ManifestObject> objects) {
  Manifest manifest;
  manifest.objects = std::move(objects);
  manifest.frames.resize(2);
  for (std::size_t frame = 0; frame < 2; ++frame) {
    manifest.frames[frame].time_s = 100 + 200 * static_cast<double>(frame);
    manifest.frames[frame].actors = {{.index = 101, .position_m = {static_cast<double>(frame), 0, 0}},
                                     {.index = 102, .position_m = {5, 0, 0}}};
  }
  return manifest;
}

ActorStates states_of(const Manifest& manifest, std::uint32_t seed = 1, const Weather& weather = {}) {
  return states_of_actors(manifest, materials(), weather, seed);
}

}  // namespace

TEST_CASE("People differ in what they do and in their clothes") {
  const Manifest manifest = scene({actor(101, "person"), actor(102, "person")});
  const ActorStates states = states_of(manifest);
  CHECK(states.of_object(101).activity == Activity::walking);
  CHECK(states.of_object(102).activity == Activity::standing);
  CHECK(states_of(manifest).classes.of_object == states.classes.of_object);
  int drawn[4] = {};
  for (std::uint32_t seed = 0; seed < 400; ++seed)
    ++drawn[static_cast<int>(4 * states_of(manifest, seed).of_object(102).dress)];
  // Binomial of 400 and a quarter: standard deviation 8.7; five of them.
  for (const int count : drawn) CHECK_THAT(count, WithinAbs(100, 44));
}

TEST_CASE("Vehicles drive if they move; others have stopped as the weather says, or each at its own time") {
  const Manifest manifest = scene({actor(101, "vehicle"), actor(102, "vehicle")});
  CHECK(states_of(manifest).of_object(101).vehicle ==
        VehicleState{.engine = EngineState::driving, .since_s = 3600});
  CHECK(states_of(manifest, 1, stopped(60)).of_object(102).vehicle ==
        VehicleState{.engine = EngineState::parked, .since_s = 60});
  std::set<double> drawn_s;
  int early = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const VehicleState state = states_of(manifest, seed).of_object(102).vehicle;
    CHECK(state.engine == EngineState::parked);
    drawn_s.insert(state.since_s);
    early += state.since_s < std::sqrt(120.0 * 43200) ? 1 : 0;
  }
  CHECK(drawn_s.size() == 16);
  CHECK(*drawn_s.begin() > 120);
  CHECK(*drawn_s.rbegin() < 43200);
  CHECK_THAT(early, WithinAbs(200, 50));  // five standard deviations of 10
  CHECK(drawn_stop_s(0) == *drawn_s.begin());
  CHECK(drawn_stop_s(1) == *drawn_s.rbegin());
}

TEST_CASE("What is stated of engines and baths holds at time 0 of the scene") {
  std::vector<ManifestObject> objects = {actor(101, "animal"), actor(102, "vehicle"), actor(103, "vehicle")};
  objects[0].wet_s = 600;
  objects[1].engine = {.engine = EngineState::idling, .since_s = 50};
  objects[2].engine = {.engine = EngineState::parked, .since_s = 1000};
  const ActorStates states = states_of(scene(objects), 1, stopped(60));
  CHECK(states.of_object(101).since_bath_s == 800);
  CHECK(states.of_object(102).vehicle == VehicleState{.engine = EngineState::idling, .since_s = 250});
  CHECK(states.of_object(103).vehicle == VehicleState{.engine = EngineState::parked, .since_s = 1200});
  CHECK(std::isinf(states.of_object(102).since_bath_s));
  CHECK(states.classes.count == 4);  // and that of what is no actor
  CHECK(states.of_object(1) == ActorState{});
}

TEST_CASE("Fires have a state each, at the middle of the clip") {
  ManifestObject burning;
  burning.index = 7;
  burning.fire = {.place_m = {1, 2}, .diameter_m = 1.2, .burning = true, .since_s = 600};
  ManifestObject embers = burning;
  embers.index = 8;
  embers.fire->burning = false;
  const ActorStates states = states_of(scene({burning, embers}));
  CHECK(states.of_object(7).fire == FireState{.fire = {.diameter_m = 1.2, .burning_s = 800}});
  CHECK(states.of_object(8).fire == FireState{.fire = {.diameter_m = 1.2}, .burning = false, .since_s = 800});
}

TEST_CASE("Actors in equal states share a class, and there are at most 250 states") {
  std::vector<ManifestObject> objects;
  for (std::uint16_t k = 0; k < 300; ++k)
    objects.push_back(actor(static_cast<std::uint16_t>(200 + k), "animal"));
  CHECK(states_of(scene(objects)).classes.count == 1);
  for (std::size_t k = 0; k < objects.size(); ++k) objects[k].wet_s = static_cast<double>(k % 249);
  CHECK(states_of(scene(objects)).classes.count == 250);
  for (std::size_t k = 0; k < objects.size(); ++k) objects[k].wet_s = static_cast<double>(k);
  CHECK(message_of<DataError>([&] { (void)states_of(scene(objects)); }) ==
        "objects = more; expected at most 250 different states of engines and baths");
}

}  // namespace actor_states_test
