#include "io/config/sensor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/config/config.h"
#include "io/json/schema.h"
#include "io/system/text_file.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace sensor_config_test {

using namespace thermal;

namespace {

Json with_sensor(const std::string& sensor) {
  return parse_json(R"({"name": "night", "sensor": )" + sensor +
                        R"(, "clips": [{"id": "a", "season": "winter", "frames": 3}]})",
                    "");
}

Json config_schema() { return kAssets.schema("config"); }

ResolvedConfig resolved(const Json& document) { return resolve_config(document, "night.json", kAssets); }

std::vector<Path> presets(const std::string& kind) {
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kAssets.folder(kind)))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  return files;
}

/// Dotted names of all values of an object.
void add_leaves(const Json& object, const std::string& prefix, std::set<std::string>& leaves) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    value.is_object() ? add_leaves(value, name + ".", leaves) : (void)leaves.insert(name);
  }
}

void check_sources(const Json& preset, const std::vector<std::string>& sections) {
  std::set<std::string> figures;
  std::set<std::string> sources;
  for (const std::string& section : sections) add_leaves(preset[section], section + ".", figures);
  for (const auto& [name, source] : preset["sources"].items()) {
    CHECK(source.get<std::string>().size() >= 8);
    sources.insert(name);
  }
  CHECK(figures == sources);
}

/// All but the response, whose samples are in a file.
bool same_figures(const SensorParameters& a, const SensorParameters& b) {
  return a.radiance == b.radiance && a.optics == b.optics && a.time_constant_s == b.time_constant_s &&
         a.readout_s == b.readout_s && a.netd_mk == b.netd_mk && a.netd_f_number == b.netd_f_number &&
         a.native_rate_hz == b.native_rate_hz && a.noise == b.noise && a.shutter == b.shutter &&
         a.housing == b.housing && a.bad_pixels == b.bad_pixels && a.accuracy_k == b.accuracy_k &&
         a.denoise == b.denoise && a.kelvin_per_count == b.kelvin_per_count &&
         a.saturation_k == b.saturation_k && a.agc == b.agc;
}

double field_of_view_deg(double size_px, const Json& camera) {
  const double half_m = 0.5e-6 * size_px * camera["pixel_pitch_um"].get<double>();
  return 2 * std::atan(half_m / camera["focal_length_m"].get<double>()) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("Defaults of schema and library are the same") {
  Json document = with_sensor("{}");
  REQUIRE(check_and_fill(document, config_schema()).empty());
  CHECK(same_figures(read_sensor(document, "night.json", kAssets), SensorParameters()));
}

TEST_CASE("Every value of a config's sensor reaches the library") {
  // Each key, set to a value other than its default, must change something.
  const Json rules = config_schema()["properties"]["sensor"]["properties"];
  const auto changes_something = [](const Json::json_pointer& key, const Json& rule) {
    Json document = with_sensor("{}");
    REQUIRE(check_and_fill(document, config_schema()).empty());
    const SensorParameters before = read_sensor(document, "", kAssets);
    Json& value = document["sensor"][key];
    if (value.is_number_integer())
      value = value.get<int>() + 1;
    else if (value.is_number())
      value = value.get<double>() == 1 ? 0.75 : value.get<double>() + 0.25;
    if (value.is_boolean()) value = !value.get<bool>();
    if (value.is_string()) value = rule["enum"].back();
    return !same_figures(read_sensor(document, "", kAssets), before);
  };
  for (const char* key : {"radiance", "netd_mk", "netd_f_number", "native_rate_hz", "time_constant_s",
                          "readout_s", "accuracy_k", "kelvin_per_count", "saturation_k"}) {
    CAPTURE(key);
    CHECK(changes_something(Json::json_pointer() / key, rules[key]));
  }
  for (const char* group : {"optics", "noise", "shutter", "housing", "bad_pixels", "denoise", "agc"}) {
    for (const auto& [key, rule] : rules[group]["properties"].items()) {
      CAPTURE(group, key);
      if (rule["type"] != "object") CHECK(changes_something(Json::json_pointer() / group / key, rule));
    }
  }
  for (const auto& [key, rule] : rules["agc"]["properties"]["detail"]["properties"].items()) {
    CAPTURE(key);
    CHECK(changes_something(Json::json_pointer("/agc/detail") / key, rule));
  }
}

TEST_CASE("Every preset is usable, and each of its figures has a source") {
  for (const Path& file : presets("sensors")) {
    CAPTURE(file.string());
    CHECK_NOTHROW(resolved(with_sensor(R"({"preset": ")" + file.stem().string() + "\"}")));
    const Json preset = read_json(file);
    CHECK(preset["camera"].size() == 4);  // whole in each file: the Blender extension reads no other
    check_sources(preset, {"camera", "sensor"});
  }
  for (const Path& file : presets("links")) {
    CAPTURE(file.string());
    Json document = with_sensor("{}");
    document["output"]["preset"] = file.stem().string();
    CHECK_NOTHROW(resolved(document));
    check_sources(read_json(file), {"output"});
  }
}

TEST_CASE("A link's preset applies where the config gives no value") {
  Json document = with_sensor("{}");
  document["output"] = {{"preset", "analogue_ntsc"}, {"link", {{"hum_hz", 50}, {"noise_levels", 8}}}};
  const ResolvedConfig config = resolved(document);
  REQUIRE(config.spec.settings->link);
  CHECK_FALSE(config.spec.settings->codec);
  CHECK(config.spec.settings->link->lines == 480);
  CHECK(config.spec.settings->link->bandwidth_mhz == 4.2);
  CHECK(config.spec.settings->link->hum_hz == 50);
  CHECK(config.spec.settings->link->noise_levels == 8);
  document["output"] = {{"preset", "dji_h264"}};
  CHECK(resolved(document).spec.settings->codec ==
        VideoCodecSettings{.name = "h264", .bitrate_kbit_s = 4000, .bitrate_at_hz = 30});
  CHECK_FALSE(resolved(document).spec.settings->link);
  document["output"] = {{"preset", "analog_pal"}};
  CHECK(message_of<ConfigError>([&] { (void)resolved(document); }) ==
        "night.json: output.preset = \"analog_pal\"; expected one of analogue_ntsc, analogue_pal, dji_h264; "
        "did "
        "you mean \"analogue_pal\"?");
}

namespace {

/// What a maker states of a camera, as it states it.
struct Sheet {
  double across_deg = 0;    ///< field of view; 0: not stated
  double down_deg = 0;      ///< likewise
  double diagonal_deg = 0;  ///< likewise
  double film_mm = 0;       ///< equivalent focal length, by the diagonals
  double lens_mm = 0;
  double netd_mk = 0;
  double f_number = 0;  ///< for which it is stated
};

const std::map<std::string, Sheet> kSheets = {
    {"boson_640_14mm", {.across_deg = 32.0, .down_deg = 25.6, .netd_mk = 40, .f_number = 1}},
    {"boson_640_18mm", {.across_deg = 24, .lens_mm = 18, .netd_mk = 40, .f_number = 1}},
    {"boson_640_25mm", {.lens_mm = 25, .netd_mk = 40, .f_number = 1}},
    {"boson_640_35mm", {.lens_mm = 35, .netd_mk = 40, .f_number = 1}},
    {"boson_plus_640_14mm", {.across_deg = 32.0, .down_deg = 25.6, .netd_mk = 20, .f_number = 1}},
    {"flir_vue_pro_640_13mm",
     {.across_deg = 45, .down_deg = 37, .lens_mm = 13, .netd_mk = 50, .f_number = 1}},
    {"flir_vue_pro_640_19mm",
     {.across_deg = 32, .down_deg = 26, .lens_mm = 19, .netd_mk = 50, .f_number = 1}},
    {"flir_vue_pro_r_640_13mm",
     {.across_deg = 45, .down_deg = 37, .lens_mm = 13, .netd_mk = 50, .f_number = 1}},
    {"flir_vue_pro_r_640_19mm",
     {.across_deg = 32, .down_deg = 26, .lens_mm = 19, .netd_mk = 50, .f_number = 1}},
    {"flir_tau_2_640_13mm", {.across_deg = 45, .down_deg = 37, .lens_mm = 13, .netd_mk = 50, .f_number = 1}},
    {"flir_tau_2_640_19mm", {.across_deg = 32, .down_deg = 26, .lens_mm = 19, .netd_mk = 50, .f_number = 1}},
    // The whole degrees of this sheet, 25 x 20, are those of a lens of 24.5 mm.
    {"flir_tau_2_640_25mm", {.lens_mm = 25, .netd_mk = 50, .f_number = 1}},
    // DJI's 61 and 45.5 deg across the diagonals include distortion: they contradict its focal lengths.
    {"dji_mavic_3t", {.film_mm = 40, .lens_mm = 9.1, .netd_mk = 50, .f_number = 1}},
    {"dji_m30t", {.film_mm = 40, .lens_mm = 9.1, .netd_mk = 50, .f_number = 1}},
    {"dji_h20t", {.diagonal_deg = 40.6, .lens_mm = 13.5, .netd_mk = 50, .f_number = 1}},
    {"dji_h20n_wide", {.film_mm = 53, .lens_mm = 12, .netd_mk = 50, .f_number = 1}},
    {"dji_h20n_tele", {.diagonal_deg = 12.5, .lens_mm = 44.5, .netd_mk = 50, .f_number = 1}},
    {"dji_h30t", {.diagonal_deg = 45.2, .lens_mm = 24, .netd_mk = 50, .f_number = 1}},
    {"autel_640t", {.across_deg = 33, .lens_mm = 13, .netd_mk = 50, .f_number = 1}},
    {"flir_lepton_3_5", {.across_deg = 57, .netd_mk = 50, .f_number = 1.1}},
    {"hikmicro_384_19mm",
     {.across_deg = 13.8, .down_deg = 10.4, .lens_mm = 19, .netd_mk = 35, .f_number = 1}},
};

/// Stated values of 0 are none.
void check_stated(double value, double stated) {
  if (stated > 0) CHECK_THAT(value, WithinRel(stated, 0.01));
}

/// Cells of the row of the table of cameras that names this preset; empty if there is none.
std::vector<std::string> row_of_readme(const std::string& preset) {
  const std::string page = read_text_file(kAssets.folder("sensors") / "README.md");
  for (const std::string_view line : split(page, '\n')) {
    if (!line.starts_with("| `" + preset + "` |")) continue;
    std::vector<std::string> cells;
    for (const std::string_view cell : split(line, '|')) cells.emplace_back(cell);
    return cells;
  }
  return {};
}

}  // namespace

TEST_CASE("Cameras have the field of view and the NETD of their data sheets, to 1 %") {
  for (const Path& file : presets("sensors")) {
    const std::string name = file.stem().string();
    if (name.starts_with("airsim_w") || name == "uncooled_640") continue;  // of no maker
    CAPTURE(name);
    REQUIRE(kSheets.contains(name));
    const Sheet& sheet = kSheets.at(name);
    const ResolvedConfig config = resolved(with_sensor(R"({"preset": ")" + name + "\"}"));
    const Json& camera = config.document["camera"];
    const double diagonal_px =
        std::hypot(camera["width_px"].get<double>(), camera["height_px"].get<double>());
    const double focal_mm = 1000 * camera["focal_length_m"].get<double>();
    check_stated(field_of_view_deg(camera["width_px"], camera), sheet.across_deg);
    check_stated(field_of_view_deg(camera["height_px"], camera), sheet.down_deg);
    check_stated(field_of_view_deg(diagonal_px, camera), sheet.diagonal_deg);
    check_stated(focal_mm, sheet.lens_mm);
    const double diagonal_mm = 1e-3 * diagonal_px * camera["pixel_pitch_um"].get<double>();
    check_stated(focal_mm * std::hypot(36, 24) / diagonal_mm, sheet.film_mm);
    check_stated(config.spec.settings->sensor.netd_mk, sheet.netd_mk);
    check_stated(config.spec.settings->sensor.netd_f_number, sheet.f_number);
  }
}

TEST_CASE("The table of cameras says what the presets have") {
  for (const Path& file : presets("sensors")) {
    const std::string name = file.stem().string();
    CAPTURE(name);
    const ResolvedConfig config = resolved(with_sensor(R"({"preset": ")" + name + "\"}"));
    const Json& camera = config.document["camera"];
    const std::vector<std::string> cells = row_of_readme(name);
    REQUIRE(cells.size() > 6);
    CHECK(cells[2] == fmt::format(" {} x {}, {} um ", camera["width_px"].get<int>(),
                                  camera["height_px"].get<int>(), camera["pixel_pitch_um"].get<double>()));
    CHECK(cells[4] == fmt::format(" {:.1f} x {:.1f} deg ", field_of_view_deg(camera["width_px"], camera),
                                  field_of_view_deg(camera["height_px"], camera)));
    CHECK(cells[5] == fmt::format(" {:.3g} mK ", 1000 * config.spec.settings->netd_k));
    CHECK(cells[6] == fmt::format(" {:.1f} cm ", 6100 / config.spec.settings->camera.fx_px));
  }
}

TEST_CASE("A preset builds on another, whose values apply wherever it gives none") {
  const ResolvedConfig config = resolved(with_sensor(R"({"preset": "flir_tau_2_640_25mm"})"));
  CHECK(config.document["sensor"]["preset"] == "flir_tau_2_640_25mm");
  CHECK(config.document["camera"]["focal_length_m"] == 0.025);        // its own
  CHECK(config.spec.settings->sensor.optics.f_number == 1.1);         // its own
  CHECK(config.spec.settings->sensor.saturation_k == 408.15);         // of the Vue Pro
  CHECK(config.document["sensor"]["response"] == "flat_7_5_13_5um");  // of the Vue Pro
  CHECK(config.spec.settings->sensor.housing.excess_k == 10);         // of any uncooled camera
  CHECK(resolved(with_sensor(R"({"preset": "boson_640_18mm"})")).spec.settings->sensor.agc.mode ==
        AgcMode::information);
}

TEST_CASE("A preset that builds on itself is an error, and so is one that builds on none that exists") {
  const TestFolder home;
  std::filesystem::create_directories(home / "assets/sensors");
  const auto fault_in = [&] {
    return message_of<ConfigError>([&] {
      Json document = with_sensor(R"({"preset": "one"})");
      apply_preset(document, config_schema(), "night.json: ", Assets(home.path()));
    });
  };
  const Path one = home.file("assets/sensors/one.json", R"({"sensor": {"preset": "two"}})");
  const Path two = home.file("assets/sensors/two.json", R"({"sensor": {"preset": "one"}})");
  CHECK(fault_in() ==
        two.string() + ": sensor.preset = \"one\"; expected a preset that does not build on this one");
  std::filesystem::remove(two);
  CHECK(fault_in() == one.string() + ": sensor.preset = \"two\"; expected one of one");
}

TEST_CASE("A config overrides its preset, value by value, and the preset overrides defaults") {
  Json document = with_sensor(R"({"preset": "boson_640_14mm", "netd_mk": 33, "noise": {"row_ratio": 0.7}})");
  document["camera"] = {{"width_px", 320}};
  const ResolvedConfig config = resolved(document);
  CHECK(config.spec.settings->sensor.netd_mk == 33);
  CHECK(config.spec.settings->sensor.noise.row_ratio == 0.7);
  CHECK(config.spec.settings->sensor.noise.column_ratio == 0.2);  // the preset's
  CHECK(config.spec.settings->sensor.noise.banding_ratio == 0);   // the schema's
  CHECK(config.spec.width_px == 320);
  CHECK(config.spec.height_px == 512);
  CHECK(config.spec.settings->sensor.optics.pixel_pitch_um == 12);
  CHECK(config.spec.physical);
  CHECK(resolved(config.document).document == config.document);
}

TEST_CASE("By default, the camera is the published one") {
  const ResolvedConfig config = resolved(with_sensor("{}"));
  CHECK(config.document["sensor"]["preset"] == "airsim_w");
  CHECK(config.spec.settings->sensor.netd_mk == 470);
  CHECK_FALSE(config.spec.physical);
}

TEST_CASE("NETD grows as the light of the lens's cone of rays falls") {
  const ResolvedConfig config = resolved(with_sensor(R"({"preset": "flir_vue_pro_640_13mm"})"));
  CHECK_THAT(config.spec.settings->netd_k, WithinRel(0.0725, 1e-12));
}

TEST_CASE("An unknown preset is an error with the nearest name") {
  std::vector<std::string> names;
  for (const Path& file : presets("sensors")) names.push_back(file.stem().string());
  std::ranges::sort(names);
  CHECK(message_of<ConfigError>([] { (void)resolved(with_sensor(R"({"preset": "boson_640_13mm"})")); }) ==
        "night.json: sensor.preset = \"boson_640_13mm\"; expected one of " + list_names(names, names.size()) +
            "; did you mean \"boson_640_14mm\"?");
}

TEST_CASE("Faults of a preset are reported with its file") {
  const TestFolder home;
  std::filesystem::create_directories(home / "assets/sensors");
  const auto fault_of = [&](const std::string& preset) {
    const Path file = home.file("assets/sensors/airsim_w.json", preset);
    const std::string message = message_of<ConfigError>([&] {
      Json document = with_sensor("{}");
      apply_preset(document, config_schema(), "night.json", Assets(home.path()));
    });
    REQUIRE(message.starts_with(file.string() + ": "));
    return message.substr(file.string().size() + 2);
  };
  CHECK(fault_of(R"({"sensor": {"netd_mk": -4}})") ==
        "sensor.netd_mk = -4 mK; expected more than 0 and at most 10000 mK");
  CHECK(
      fault_of(R"({"sensr": {}})") ==
      "sensr is not a known key; expected one of description, camera, sensor, models, sources; did you mean "
      "\"sensor\"?");
  CHECK(fault_of("[]") == "document = a list of 0; expected an object");
}

}  // namespace sensor_config_test
