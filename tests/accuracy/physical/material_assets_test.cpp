#include <filesystem>

#include "accuracy/physical/assets.h"
#include "base/error.h"
#include "io/json/file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace material_assets_test {

using namespace thermal;

namespace {

/// A folder with the materials in assets and another one: "odd".
class Home {
 public:
  explicit Home(const std::string& odd_material) {
    const Path source = VELDT_SOURCE_DIR;
    std::filesystem::create_directories(folder_ / "configs");
    std::filesystem::create_directories(folder_ / "assets");
    const auto all = std::filesystem::copy_options::recursive;
    std::filesystem::copy(source / "configs" / "schema", folder_ / "configs/schema", all);
    std::filesystem::copy(source / "assets" / "materials", folder_ / "assets/materials", all);
    (void)folder_.file("assets/materials/odd.json", odd_material);
  }

  /// A CSV beside the materials.
  void add_spectrum(const std::string& content) const {
    (void)folder_.file("assets/materials/odd.csv", content);
  }

  [[nodiscard]] MaterialLibrary read() const { return read_materials(Assets(folder_.path())); }

  /// The error message; "ODD" stands for the file's full name without extension.
  [[nodiscard]] std::string fault() const {
    const std::string full = (folder_ / "assets/materials/odd").string();
    std::string message = message_of<ConfigError>([&] { (void)read(); });
    const std::size_t at = message.find(full);
    return at == std::string::npos ? message : message.replace(at, full.size(), "ODD");
  }

 private:
  TestFolder folder_;
};

/// A material with a few optional keys.
std::string with(const std::string& keys) {
  return R"({"emissivity": 0.9, "winter_k": 273, "summer_k": 293, "source": "a test", )" + keys + "}";
}

}  // namespace

TEST_CASE("Every material and every part states the source of its figures") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VELDT_SOURCE_DIR "/assets/materials")) {
    if (entry.path().extension() != ".json") continue;
    CAPTURE(entry.path().filename().string());
    const Json json = read_json(entry.path());
    CHECK(json.at("source").get<std::string>().size() > 10);
    const Json parts = json.value("parts", Json::object());
    for (const auto& [name, part] : parts.items()) {
      CAPTURE(name);
      CHECK(part.at("source").get<std::string>().size() > 10);
    }
    ++files;
  }
  CHECK(materials().names().size() == static_cast<std::size_t>(files));
  CHECK(files >= 16);
}

TEST_CASE("Ground and plants vary as much as measured in the field, animals not at all") {
  const auto stddev_k = [](const char* name) { return material(name).variation.stddev_k; };
  CHECK((stddev_k("soil") >= 0.5 && stddev_k("soil") <= 1.5));
  CHECK((stddev_k("grass") >= 0.5 && stddev_k("grass") <= 1));
  CHECK((stddev_k("acacia") >= 0.3 && stddev_k("acacia") <= 0.8));
  for (const char* name : {"human", "elephant", "zebra", "truck", "sky"}) CHECK(stddev_k(name) == 0);
  CHECK(material("water").angular == AngularLaw::water);
  CHECK(material("soil").angular == AngularLaw::soil);
  CHECK(material("grass").angular == AngularLaw::none);
}

TEST_CASE("A spectrum is read from a CSV beside its material") {
  const Home home(with(R"("spectrum": "odd.csv")"));
  home.add_spectrum("wavelength_um,emissivity\n7,0.75\n9.35,0.75\n9.45,0.97\n15,0.97\n");
  const MaterialLibrary library = home.read();
  const auto& spectrum = library.find("odd", "test").spectrum;
  REQUIRE(spectrum);
  CHECK(spectrum->at(8) == 0.75);
  CHECK(spectrum->at(12) == 0.97);
}

TEST_CASE("A faulty spectrum is reported with its line or rule") {
  const Home home(with(R"("spectrum": "odd.csv")"));
  home.add_spectrum("wavelength_um,emissivity\n7,0.75\n9,1.5\n");
  CHECK(home.fault() == "ODD.csv: emissivity at 9 um = 1.5; expected from 0 to 1");
  home.add_spectrum("wavelength_um,emissivity\n9,0.75\n7,0.5\n");
  CHECK(home.fault() ==
        "ODD.csv: emissivity spectrum: wavelength = 7 um; expected a finite number above 9 um");
  home.add_spectrum("wavelength_um,response\n7,0.75\n9,1\n");
  CHECK(home.fault() ==
        R"(ODD.csv:1 = "wavelength_um,response"; expected the header wavelength_um,emissivity)");
}

TEST_CASE("A faulty material is reported with its file and key") {
  const auto fault = [](const std::string& keys) { return Home(with(keys)).fault(); };
  CHECK(fault(R"("angular": "ice")") == R"(ODD.json: angular = "ice"; expected one of none, water, soil)");
  CHECK(fault(R"("variation": {"stddev_k": -1})") ==
        "ODD.json: variation.stddev_k = -1 K; expected at least 0 and at most 50 K");
  CHECK(fault(R"("parts": {"ear": {"offset_k": 1}})") ==
        "ODD.json: parts.ear.source is missing; expected a value");
  CHECK(fault(R"("parts": {"ear": {"source": "a test", "cooling_time_s": 0}})") ==
        "ODD.json: parts.ear.cooling_time_s = 0 s; expected more than 0 and at most 1000000 s");
  CHECK(fault(R"("parts": {"wood": {"source": "x", "heat": {"source": "x"}}})") ==
        "ODD.json: parts.wood.heat = nothing; expected one of ground, leaves and slab");
  CHECK(fault(R"("parts": {"wood": {"source": "x", "heat": {"band_emissivity": 0.9, "source": "x"}}})") ==
        "ODD.json: parts.wood.heat.band_emissivity = 0.9; expected none, because parts have the emissivity "
        "of their "
        "material");
  CHECK(fault(R"("emisivity": 0.9)") ==
        "ODD.json: emisivity is not a known key; expected one of emissivity, winter_k, summer_k, colour, "
        "in_table_1, "
        "spectrum, "
        R"(angular, variation, parts, heat, body_heat, source; did you mean "emissivity"?)");
}

}  // namespace material_assets_test
