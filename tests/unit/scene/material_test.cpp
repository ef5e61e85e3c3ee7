#include "scene/material.h"

#include <limits>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace material_test {

using namespace thermal;

namespace {

Material clay() {
  Material material;
  material.name = "clay";
  material.emissivity = 0.93;
  material.winter_k = 270;
  material.summer_k = 290;
  return material;
}

std::string fault_in(const Material& material) {
  return message_of<ConfigError>([&] { material.validate(); });
}

MaterialLibrary library_of(const std::vector<std::string>& names) {
  MaterialLibrary library;
  for (const std::string& name : names) {
    Material material = clay();
    material.name = name;
    library.add(material);
  }
  return library;
}

}  // namespace

TEST_CASE("A material has a temperature for each of Table 1's nights") {
  CHECK_NOTHROW(clay().validate());
  CHECK(clay().temperature_k(Season::winter) == 270);
  CHECK(clay().temperature_k(Season::summer) == 290);
}

TEST_CASE("An emissivity is above 0 and at most 1") {
  Material material = clay();
  material.emissivity = 1;
  CHECK_NOTHROW(material.validate());
  const auto [emissivity, text] = GENERATE(table<double, std::string>(
      {{0, "0"}, {-0.5, "-0.5"}, {1.001, "1.001"}, {std::numeric_limits<double>::quiet_NaN(), "nan"}}));
  material.emissivity = emissivity;
  CHECK(fault_in(material) == "material clay: emissivity = " + text + "; expected above 0 and at most 1");
}

TEST_CASE("A temperature is above 0 K and plausible for a savanna") {
  Material cold = clay();
  cold.winter_k = 0;
  CHECK(fault_in(cold) == "material clay: winter_k = 0 K; expected above 0 K and at most 2000 K");
  Material hot = clay();
  hot.summer_k = 2000.5;
  CHECK(fault_in(hot) == "material clay: summer_k = 2000.5 K; expected above 0 K and at most 2000 K");
  Material unknown = clay();
  unknown.winter_k = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_in(unknown) == "material clay: winter_k = nan K; expected above 0 K and at most 2000 K");
}

TEST_CASE("A library finds its materials, and lists them in order") {
  const MaterialLibrary library = library_of({"soil", "grass"});
  CHECK(library.find("grass", "test").name == "grass");
  CHECK(library.names() == std::vector<std::string>{"grass", "soil"});
}

TEST_CASE("An unknown material is an error with its place, the known ones, and the nearest") {
  const MaterialLibrary library = library_of({"soil", "grass", "water"});
  CHECK(message_of<ConfigError>([&] { (void)library.find("gras", "object 3: material"); }) ==
        "object 3: material = \"gras\"; expected one of grass, soil, water; did you mean \"grass\"?");
  CHECK(message_of<ConfigError>([&] { (void)library.find("marble", "object 3: material"); }) ==
        "object 3: material = \"marble\"; expected one of grass, soil, water");
}

TEST_CASE("A name is unique, and invalid materials are rejected") {
  MaterialLibrary library = library_of({"clay"});
  CHECK(message_of<ConfigError>([&] { library.add(clay()); }) ==
        "material clay is defined twice; expected unique names");
  Material black = clay();
  black.name = "black";
  black.emissivity = 2;
  CHECK_THROWS_AS(library.add(black), ConfigError);
  CHECK(library.names() == std::vector<std::string>{"clay"});
}

}  // namespace material_test
