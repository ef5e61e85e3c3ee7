#include "io/config/sensor.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/error.h"
#include "io/config/config.h"
#include "io/json/schema.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sensor_config_test {

using namespace thermal;

namespace {

Json with_sensor(const std::string& sensor) {
  return parse_json(R"({"name": "night", "sensor": )" + sensor +
                        R"(, "clips": [{"id": "a", "season": "winter", "frames": 3}]})",
                    "");
}

Json config_schema() { return kAssets.schema("config"); }

Config resolved(const Json& document) { return resolve_config(document, "night.json", kAssets); }

std::vector<Path> presets() {
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kAssets.folder("sensors")))
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

/// All but the response, whose samples are in a file.
bool same_figures(const SensorParameters& a, const SensorParameters& b) {
  return a.radiance == b.radiance && a.optics == b.optics && a.time_constant_s == b.time_constant_s &&
         a.readout_s == b.readout_s && a.netd_mk == b.netd_mk && a.netd_f_number == b.netd_f_number &&
         a.native_rate_hz == b.native_rate_hz && a.noise == b.noise && a.shutter == b.shutter &&
         a.housing == b.housing && a.bad_pixels == b.bad_pixels && a.accuracy_k == b.accuracy_k &&
         a.denoise == b.denoise && a.kelvin_per_count == b.kelvin_per_count && a.agc == b.agc;
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
                          "readout_s", "accuracy_k", "kelvin_per_count"}) {
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
  for (const Path& file : presets()) {
    CAPTURE(file.string());
    CHECK_NOTHROW(resolved(with_sensor(R"({"preset": ")" + file.stem().string() + "\"}")));
    const Json preset = read_json(file);
    std::set<std::string> figures;
    std::set<std::string> sources;
    add_leaves(preset["camera"], "camera.", figures);
    add_leaves(preset["sensor"], "sensor.", figures);
    for (const auto& [name, source] : preset["sources"].items()) {
      CHECK(source.get<std::string>().size() >= 8);
      sources.insert(name);
    }
    CHECK(figures == sources);
  }
}

TEST_CASE("The cameras have the fields of view of their data sheets") {
  const std::map<std::string, std::pair<double, double>> sheets_deg = {{"flir_vue_pro_640_13mm", {45.4, 37}},
                                                                       {"flir_vue_pro_640_19mm", {32, 26}},
                                                                       {"boson_640_14mm", {30.7, 24.8}},
                                                                       {"boson_640_18mm", {24.1, 19.4}},
                                                                       {"airsim_w_256x144", {90, 58.7}}};
  for (const auto& [name, sheet_deg] : sheets_deg) {
    CAPTURE(name);
    const Json camera = resolved(with_sensor(R"({"preset": ")" + name + "\"}")).resolved["camera"];
    // Data sheets round to a tenth or to a whole degree; a focal length that is off by a millimetre changes 1 deg or
    // more.
    const double allowed_deg = 0.3;
    CHECK_THAT(field_of_view_deg(camera["width_px"], camera), WithinAbs(sheet_deg.first, allowed_deg));
    CHECK_THAT(field_of_view_deg(camera["height_px"], camera), WithinAbs(sheet_deg.second, allowed_deg));
  }
}

TEST_CASE("A config overrides its preset, value by value, and the preset overrides defaults") {
  Json document = with_sensor(R"({"preset": "boson_640_14mm", "netd_mk": 33, "noise": {"row_ratio": 0.7}})");
  document["camera"] = {{"width_px", 320}};
  const Config config = resolved(document);
  CHECK(config.sensor.netd_mk == 33);
  CHECK(config.sensor.noise.row_ratio == 0.7);
  CHECK(config.sensor.noise.column_ratio == 0.2);  // the preset's
  CHECK(config.sensor.noise.banding_ratio == 0);   // the schema's
  CHECK(config.width_px == 320);
  CHECK(config.height_px == 512);
  CHECK(config.sensor.optics.pixel_pitch_um == 12);
  CHECK(config.physical);
  CHECK(resolved(config.resolved).resolved == config.resolved);
}

TEST_CASE("By default, the camera is the published one") {
  const Config config = resolved(with_sensor("{}"));
  CHECK(config.resolved["sensor"]["preset"] == "airsim_w");
  CHECK(config.sensor.netd_mk == 470);
  CHECK_FALSE(config.physical);
}

TEST_CASE("NETD grows as the light of the lens's cone of rays falls") {
  const Config config = resolved(with_sensor(R"({"preset": "flir_vue_pro_640_13mm"})"));
  CHECK_THAT(config.netd_k, WithinRel(0.0725, 1e-12));
}

TEST_CASE("An unknown preset is an error with the nearest name") {
  CHECK(message_of<ConfigError>([] { (void)resolved(with_sensor(R"({"preset": "boson_640_13mm"})")); }) ==
        "night.json: sensor.preset = \"boson_640_13mm\"; expected one of airsim_w, airsim_w_256x144, "
        "boson_640_14mm, boson_640_18mm, flir_vue_pro_640_13mm, flir_vue_pro_640_19mm; did you mean "
        "\"boson_640_14mm\"?");
}

TEST_CASE("Faults of a preset are reported with its file") {
  const TemporaryFolder home;
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
  CHECK(fault_of(R"({"sensr": {}})") ==
        "sensr is not a known key; expected one of description, camera, sensor, sources; did you mean "
        "\"sensor\"?");
  CHECK(fault_of("[]") == "document = a list of 0; expected an object");
}

}  // namespace sensor_config_test
