#include "scene/manifest.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace manifest_test {

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

TEST_CASE("A valid manifest has no fault") { CHECK_NOTHROW(example().validate()); }

TEST_CASE("Indices are unique") {
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

TEST_CASE("Actors have a category and a unique track") {
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

TEST_CASE("Other objects need neither") {
  Manifest manifest = example();
  manifest.objects[0].track_id = 1;  // a plant's, which is never read
  CHECK_NOTHROW(manifest.validate());
}

TEST_CASE("A pose belongs to an actor") {
  Manifest manifest = example();
  manifest.frames[0].actors.push_back({7, {0, 0, 0}, 0});
  CHECK(fault_in(manifest) == "frames[0].actors[1].index = 7; expected the index of an actor in objects");
  manifest.frames[0].actors[1].index = 1;
  CHECK(fault_in(manifest) == "frames[0].actors[1].index = 1; expected the index of an actor in objects");
}

TEST_CASE("Frames are listed or have a pattern, not both") {
  Manifest manifest = example();
  manifest.sequence = "f_####.exr";
  CHECK(fault_in(manifest) == "sequence = \"f_####.exr\"; expected none, because frames lists the files");
  manifest.frames.clear();
  CHECK_NOTHROW(manifest.validate());
  manifest.sequence.clear();
  CHECK_NOTHROW(manifest.validate());  // the files are then named when it is used
}

TEST_CASE("A colour belongs to one object") {
  Manifest manifest = example();
  manifest.objects[0].colour = thermal::Colour{1, 2, 3};
  manifest.objects[2].colour = thermal::Colour{3, 2, 1};
  CHECK_NOTHROW(manifest.validate());
  SECTION("twice") {
    manifest.objects[2].colour = thermal::Colour{1, 2, 3};
    CHECK(fault_in(manifest) ==
          "objects[2].colour = #010203 (1, 2, 3); expected a colour other than objects[0].colour");
  }
  SECTION("the sky's") {
    manifest.objects[2].colour = thermal::Colour{0, 0, 0};
    CHECK(fault_in(manifest) ==
          "objects[2].colour = #000000 (0, 0, 0); expected a colour other than sky_colour");
    manifest.sky_colour = {9, 9, 9};
    CHECK_NOTHROW(manifest.validate());
  }
}

}  // namespace manifest_test
