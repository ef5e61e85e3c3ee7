#include "scene/manifest.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace thermal;

namespace {

/// Ground and two actors, one of which is seen in the only frame.
Manifest example() {
  Manifest manifest;
  manifest.objects.resize(3);
  manifest.objects[0].index = 1;
  for (std::uint16_t i = 1; i < 3; ++i) {
    ManifestObject& actor = manifest.objects[i];
    actor.index = static_cast<std::uint16_t>(i + 1);
    actor.object_class = ObjectClass::actor;
    actor.category = "human";
    actor.track_id = i;
  }
  manifest.materials = {{1, "grass", ""}, {2, "soil", ""}};
  manifest.frames.resize(1);
  manifest.frames[0].actors = {{2, {0, 0, 0}, 0}};
  return manifest;
}

std::string fault_in(const Manifest& manifest) {
  return message_of<DataError>([&] { manifest.validate(); });
}

}  // namespace

TEST_CASE("A manifest that makes sense has no fault") { CHECK_NOTHROW(example().validate()); }

TEST_CASE("Indices come once") {
  Manifest manifest = example();
  SECTION("of objects") {
    manifest.objects[2].index = 1;
    CHECK(fault_in(manifest) == "objects[2].index = 1; expected each value once");
  }
  SECTION("of materials") {
    manifest.materials[1].index = 1;
    CHECK(fault_in(manifest) == "materials[1].index = 1; expected each value once");
  }
  SECTION("but an object and a material may share one") { CHECK_NOTHROW(manifest.validate()); }
}

TEST_CASE("Actors have a category and a track of their own") {
  Manifest manifest = example();
  SECTION("no category") {
    manifest.objects[1].category.clear();
    CHECK(fault_in(manifest) == "objects[1].category is missing; expected one for every actor");
  }
  SECTION("no track") {
    manifest.objects[2].track_id = 0;
    CHECK(fault_in(manifest) == "objects[2].track_id is missing; expected one for every actor");
  }
  SECTION("another's track") {
    manifest.objects[2].track_id = 1;
    CHECK(fault_in(manifest) == "objects[2].track_id = 1; expected each value once");
  }
}

TEST_CASE("What is no actor needs neither") {
  Manifest manifest = example();
  manifest.objects[0].track_id = 1;  // a plant's, which nobody reads
  CHECK_NOTHROW(manifest.validate());
}

TEST_CASE("A pose is that of an actor") {
  Manifest manifest = example();
  manifest.frames[0].actors.push_back({7, {0, 0, 0}, 0});
  CHECK(fault_in(manifest) == "frames[0].actors[1].index = 7; expected the index of an actor in objects");
  manifest.frames[0].actors[1].index = 1;
  CHECK(fault_in(manifest) == "frames[0].actors[1].index = 1; expected the index of an actor in objects");
}
