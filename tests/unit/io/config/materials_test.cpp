#include "io/config/materials.h"

#include <algorithm>

#include "base/error.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace material_files_test {

using namespace thermal;

namespace {

/// A home with the real schemas and one material of this content.
struct Home {
  explicit Home(const std::string& content) {
    std::filesystem::create_directories(folder / "assets/materials");
    std::filesystem::create_directories(folder / "configs");
    std::filesystem::copy(Path(VELDT_SOURCE_DIR) / "configs/schema", folder / "configs/schema");
    file = folder.file("assets/materials/clay.json", content);
  }
  [[nodiscard]] Assets assets() const { return Assets(folder.path()); }
  TestFolder folder;
  Path file;
};

}  // namespace

// Bondi et al., COMPASS 2018, Table 1 (night).
TEST_CASE("The materials in assets contain Table 1") {
  struct Row {
    std::string name;
    double winter_k;
    double summer_k;
    double emissivity;
  };
  const std::vector<Row> table_1 = {
      {"soil", 278, 288, .914},     {"grass", 273, 293, .958},     {"shrub", 273, 293, .986},
      {"acacia", 273, 293, .952},   {"human", 292, 301, .985},     {"elephant", 290, 298, .96},
      {"zebra", 298, 307, .98},     {"rhinoceros", 291, 299, .96}, {"hippopotamus", 290, 298, .96},
      {"crocodile", 295, 303, .96}, {"water", 273, 293, .96},      {"truck", 273, 293, .80}};
  const MaterialLibrary library = read_materials(kAssets);
  for (const Row& row : table_1) {
    CAPTURE(row.name);
    const Material& material = library.find(row.name, "test");
    CHECK(material.temperature_k(Season::winter) == row.winter_k);
    CHECK(material.temperature_k(Season::summer) == row.summer_k);
    CHECK(material.emissivity == row.emissivity);
    CHECK(material.in_table_1);
  }
  const auto& all = library.all();
  CHECK(std::count_if(all.begin(), all.end(), [](const auto& entry) { return entry.second.in_table_1; }) ==
        12);
  CHECK_NOTHROW(library.find("sky", "test"));
}

TEST_CASE("A material's name is its file's") {
  const Home home(R"({"emissivity": 0.9, "winter_k": 270, "summer_k": 290, "source": "a test"})");
  const MaterialLibrary library = read_materials(home.assets());
  CHECK(library.names() == std::vector<std::string>{"clay"});
  CHECK(library.find("clay", "test").winter_k == 270);
}

TEST_CASE("A fault in a material names its file") {
  const Home too_bright(R"({"emissivity": 1.2, "winter_k": 270, "summer_k": 290, "source": "a test"})");
  CHECK_THAT(message_of<ConfigError>([&] { (void)read_materials(too_bright.assets()); }),
             StartsWith(too_bright.file.string() + ": emissivity = 1.2; expected ") && EndsWith("at most 1"));
  const Home no_source(R"({"emissivity": 0.9, "winter_k": 270, "summer_k": 290})");
  CHECK(message_of<ConfigError>([&] { (void)read_materials(no_source.assets()); }) ==
        no_source.file.string() + ": source is missing; expected a value");
}

}  // namespace material_files_test
