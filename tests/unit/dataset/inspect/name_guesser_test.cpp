#include "dataset/inspect/name_guesser.h"

#include "support/assets.h"
#include "support/catch.h"

namespace name_guesser_test {

using thermal::KnownThing;
using thermal::ObjectClass;
using Words = std::vector<std::string>;

namespace {

KnownThing thing(ObjectClass object_class, const char* material, const char* category = "",
                 const char* species = "") {
  return {.object_class = object_class, .material = material, .category = category, .species = species};
}

}  // namespace

TEST_CASE("words of a name") {
  CHECK(thermal::words_of("Elephant_bull.001") == Words{"elephant", "bull"});
  CHECK(thermal::words_of("elephantBull") == Words{"elephant", "bull"});
  CHECK(thermal::words_of("ZEBRA 07") == Words{"zebra"});
  CHECK(thermal::words_of("12_.-").empty());
  CHECK(thermal::words_of("").empty());
}

TEST_CASE("things are recognised by their names") {
  const thermal::NameGuesser known(kAssets);
  CHECK(known.find("Elephant.001") == thing(ObjectClass::actor, "elephant", "elephant", "elephant"));
  CHECK(known.find("two zebras") == thing(ObjectClass::actor, "zebra", "zebra", "zebra"));
  CHECK(known.find("Poacher_A") == thing(ObjectClass::actor, "human", "human", "human"));
  CHECK(known.find("SM_Jeep") == thing(ObjectClass::actor, "truck", "vehicle", "pickup"));
  CHECK(known.find("Acacia.012") == thing(ObjectClass::plant, "acacia"));
  CHECK(known.find("Plane") == thing(ObjectClass::ground, "soil"));
  CHECK(known.find("Grass") == thing(ObjectClass::ground, "grass"));
  CHECK(known.find("lake") == thing(ObjectClass::water, "water"));
  CHECK_FALSE(known.find("Cube.001").has_value());
  CHECK_FALSE(known.find("object_12").has_value());
  CHECK_FALSE(known.find("").has_value());
}

TEST_CASE("two words take precedence over one, and the first over the second") {
  const thermal::NameGuesser known(kAssets);
  CHECK(known.find("Elephant Grass 3") == thing(ObjectClass::plant, "elephant_grass"));
  CHECK(known.find("dry termite mound") == thing(ObjectClass::plant, "termite_mound"));
  CHECK(known.find("human on elephant")->material == "human");
}

}  // namespace name_guesser_test
