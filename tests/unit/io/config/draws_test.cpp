#include "io/config/draws.h"

#include "base/error.h"
#include "io/config/config.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace draws_test {

using namespace thermal;

namespace {

/// Two clips of a physical camera, with what a test changes.
Json night(const char* changes = "{}") {
  Json document = parse_json(R"({"name": "night", "sensor": {"preset": "boson_640_14mm"}, "clips": [
      {"id": "a", "season": "winter", "frames": 3, "flight": {"pattern": "zigzag"}},
      {"id": "b", "season": "summer", "frames": 4, "flight": {"pattern": "zigzag"}}]})",
                             "");
  document.merge_patch(parse_json(changes, ""));
  return document;
}

ResolvedConfig resolved(const Json& document) { return resolve_config(document, "night.json", kAssets); }

std::string fault_in(const Json& document) {
  return message_of<ConfigError>([&] { (void)resolved(document); });
}

const ClipSettings& settings(const ResolvedConfig& config, const char* clip) {
  return *config.spec.clip(clip, "test").settings;
}

}  // namespace

TEST_CASE("A clip's sections change its settings, and leave the dataset's alone") {
  Json document = night(R"({"weather": {"wind_m_s": 2}})");
  document["clips"][1]["weather"] = {{"air_temperature_k", 280}};
  document["clips"][1]["sensor"] = {{"preset", "flir_vue_pro_640_13mm"}};
  document["clips"][1]["terms"] = {{"path", "off"}};
  document["clips"][1]["labels"] = {{"ignore_below_area_px", 5}};
  document["clips"][1]["output"]["codec"] = {{"name", "mjpeg"}, {"bitrate_kbit_s", 90}};
  document["clips"][1]["camera"] = {{"focal_length_m", 0.02}};
  const ResolvedConfig config = resolved(document);
  CHECK(config.spec.clips[0].settings == config.spec.settings);
  CHECK(config.spec.settings->sensor.netd_mk == 40);
  const ClipSettings& own = settings(config, "b");
  CHECK(own.weather[1].air.temperature_k == 280);
  CHECK(own.weather[1].day.night_wind_m_s == 2);
  CHECK(own.sensor.netd_mk == 50);
  CHECK(own.terms.path == TermChoice::off);
  CHECK(own.labels.ignore_below_area_px == 5);
  REQUIRE(own.codec);
  CHECK(own.codec->name == "mjpeg");
  CHECK_THAT(own.camera.fx_px, WithinRel(0.02 / 17e-6, 1e-12));  // the pixels are those of its preset
}

TEST_CASE("A resolved clip keeps what differs, and resolves to the same again") {
  Json document = night(R"({"output": {"codec": {"name": "h264", "bitrate_kbit_s": 100}}})");
  document["clips"][1]["sensor"] = {{"preset", "flir_vue_pro_640_13mm"}, {"noise", {{"amount", 1}}}};
  document["clips"][1]["output"]["codec"] = nullptr;
  const ResolvedConfig config = resolved(document);
  const Json& clip = config.document["clips"][1];
  CHECK(clip["sensor"]["netd_mk"] == 50);
  CHECK_FALSE(clip["sensor"].contains("kelvin_per_count"));
  CHECK(clip["output"] == parse_json(R"({"codec": null})", ""));
  CHECK_FALSE(settings(config, "b").codec);
  const ResolvedConfig again = resolved(config.document);
  CHECK(again.document == config.document);
  CHECK_FALSE(settings(again, "b").codec);
  CHECK(settings(again, "b").sensor.netd_mk == 50);
}

TEST_CASE("What all clips of a dataset share cannot differ") {
  Json document = night();
  document["clips"][0]["camera"] = {{"width_px", 320}};
  CHECK(fault_in(document) ==
        "night.json: clips[0].camera.width_px = 320 px; expected 640 px, the dataset's: all clips have the "
        "same");
  document = night();
  document["clips"][1]["weather"] = {{"latitude_deg", 3}};
  CHECK(fault_in(document) ==
        "night.json: clips[1].weather.latitude_deg = 3 deg; expected none, the dataset's: all clips have the "
        "same");
}

TEST_CASE("Faults in a clip's sections start with its place") {
  Json document = night();
  document["clips"][1]["weather"] = {{"wind_m_s", 70}, {"wimd", 3}};
  CHECK_THAT(
      fault_in(document),
      StartsWith("night.json: clips[1].weather.wind_m_s = 70 m/s; expected at least 0 and at most 60 m/s\n"
                 "night.json: clips[1].weather.wimd is not a known key; expected one of date, "));
}

TEST_CASE("A fault in an entry with a count is reported once, where the config has it") {
  Json document = night();
  document["clips"].push_back(parse_json(
      R"({"id": "p", "count": 20, "season": "winter", "frames": 3, "flight": {"pattern": "zigzag"}})", ""));
  const auto fault_with = [&](const char* changes) {
    Json changed = document;
    changed["clips"][2].merge_patch(parse_json(changes, ""));
    return fault_in(changed);
  };
  const std::string place = R"(night.json: clips[2] ("p", 20 clips))";
  CHECK(fault_with(R"({"flight": {"altitude_m": 9000}, "frames": 0})") ==
        place + ".frames = 0; expected at least 1 and at most 1000000\n" + place +
            ".flight.altitude_m = 9000 m; expected at least -1000 and at most 5000 m");
  CHECK_THAT(fault_with(R"({"flight": {"altitude": 60}})"),
             StartsWith(place + ".flight.altitude is not a known key; expected one of pattern, ") &&
                 EndsWith("did you mean \"altitude_m\"?"));
  CHECK(fault_with(R"({"season": null})") == place + ".season is missing; expected a value");
  CHECK(fault_with(R"({"weather": {"wind_m_s": 70}})") ==
        place + ".weather.wind_m_s = 70 m/s; expected at least 0 and at most 60 m/s");
  CHECK(fault_with(R"({"flight": {"altitude_m": {"uniform": [70, 60]}}})") ==
        place + ".flight.altitude_m.uniform = [70,60]; expected the lowest first");
  CHECK(fault_with(R"({"count": 0, "id": "a.b"})") ==
        "night.json: clips[2].id = \"a.b\"; expected 1 to 200 letters, digits, _ or -, not beginning with -\n"
        "night.json: clips[2].count = 0; expected at least 1 and at most 100000");
  CHECK(fault_with(R"({"count": 1, "frames": 0})") ==
        R"(night.json: clips[2] ("p", 1 clip).frames = 0; expected at least 1 and at most 1000000)");
}

TEST_CASE("Ids that entries with counts share are reported once for each entry") {
  Json document = night();
  const Json counted = parse_json(
      R"({"id": "p", "count": 3, "season": "winter", "frames": 3, "flight": {"pattern": "zigzag"}})", "");
  document["clips"] = {counted, counted, document["clips"][0]};
  document["clips"][2]["id"] = "p_0002";
  CHECK(fault_in(document) ==
        "night.json: clips[1] (\"p\", 3 clips).id = \"p_0000\"; expected each id once\n"
        "night.json: clips[2].id = \"p_0002\"; expected each id once");
}

TEST_CASE("Each clip draws its own values, and numbers are all that is left") {
  const ResolvedConfig config =
      resolved(night(R"({"weather": {"air_temperature_k": {"uniform": [270, 290]}}})"));
  const double a_k = settings(config, "a").weather[0].air.temperature_k;
  const double b_k = settings(config, "b").weather[1].air.temperature_k;
  CHECK(a_k != b_k);
  CHECK((a_k >= 270 && a_k <= 290));
  CHECK((b_k >= 270 && b_k <= 290));
  CHECK(config.document["clips"][0]["weather"]["air_temperature_k"] == a_k);
  CHECK(config.document["clips"][0]["drawn"] == parse_json(R"(["weather.air_temperature_k"])", ""));
  CHECK(config.document["drawn"] == parse_json(R"(["weather.air_temperature_k"])", ""));
  CHECK(resolved(config.document).document == config.document);
}

TEST_CASE("A draw depends on seed, clip and key alone") {
  const char* weather = R"({"weather": {"air_temperature_k": {"uniform": [270, 290]}}})";
  const double alone_k = settings(resolved(night(weather)), "b").weather[1].air.temperature_k;
  Json more = night(weather);
  more["weather"]["wind_m_s"] = parse_json(R"({"uniform": [1, 3]})", "");
  more["clips"].insert(more["clips"].begin(), more["clips"][0]);
  more["clips"][0]["id"] = "first";
  CHECK(settings(resolved(more), "b").weather[1].air.temperature_k == alone_k);
  more["seed"] = 2;
  CHECK(settings(resolved(more), "b").weather[1].air.temperature_k != alone_k);
}

TEST_CASE("Nothing can be drawn, and unknown keys are left to the schema") {
  Json document = night();
  document["clips"][0]["flight"]["turbulence"] = parse_json(R"({"choice": [null]})", "");
  const ResolvedConfig config = resolved(document);
  CHECK(config.document["clips"][0]["flight"]["turbulence"] == "none");
  document["weather"]["a~b"] = parse_json(R"({"choice": [1]})", "");
  CHECK_THAT(fault_in(document), StartsWith("night.json: weather.a~b is not a known key; expected one of "));
}

TEST_CASE("What a clip gives itself is not drawn for it") {
  Json document = night(R"({"weather": {"air_temperature_k": {"uniform": [270, 290]}}})");
  document["clips"][0]["weather"] = {{"air_temperature_k", 280}};
  const ResolvedConfig config = resolved(document);
  CHECK(settings(config, "a").weather[0].air.temperature_k == 280);
  CHECK_FALSE(config.document["clips"][0].contains("drawn"));
}

TEST_CASE("A choice of objects is complete, whatever the dataset has drawn") {
  const Json document = night(R"({"weather": {"choice": [
      {"air_min_k": 270, "air_max_k": 290}, {"air_temperature_k": {"normal": [280, 2]}}, {"wind_m_s": 1}]}})");
  Json many = document;
  many["clips"] = parse_json(
      R"([{"id": "n", "count": 20, "season": {"choice": ["winter", "summer"]}, "frames": 1}])", "");
  const ResolvedConfig config = resolved(many);
  REQUIRE(config.spec.clips.size() == 20);
  CHECK(config.spec.clips[0].id == "n_0000");
  CHECK(config.spec.clips[19].id == "n_0019");
  int winters = 0;
  for (const ClipSpec& clip : config.spec.clips) winters += clip.season == Season::winter ? 1 : 0;
  CHECK((winters > 0 && winters < 20));
}

TEST_CASE("The scene and what clips share are drawn once") {
  const ResolvedConfig config = resolved(night(R"({"scene": {"terrain": {"relief_m": {"uniform": [5, 9]}}},
      "weather": {"latitude_deg": {"uniform": [-25, -15]}}})"));
  const double relief_m = config.document["scene"]["terrain"]["relief_m"];
  CHECK((relief_m >= 5 && relief_m <= 9));
  for (const ClipSpec& clip : config.spec.clips) CHECK(clip.settings == config.spec.settings);
  CHECK(config.document["drawn"] == parse_json(R"(["scene.terrain.relief_m", "weather.latitude_deg"])", ""));
}

TEST_CASE("Distributions that cannot be drawn are refused") {
  const auto fault_with = [](const char* key, const char* distribution) {
    Json document = night();
    document["weather"][key] = parse_json(distribution, "");
    return fault_in(document);
  };
  CHECK(fault_with("wind_m_s", R"({"unifrom": [1, 2]})") ==
        "night.json: weather.wind_m_s.unifrom is not a known distribution; expected one of uniform, normal, "
        "choice; "
        "did you mean \"uniform\"?");
  CHECK(fault_with("wind_m_s", R"({"uniform": [3, 2]})") ==
        "night.json: weather.wind_m_s.uniform = [3,2]; expected the lowest first");
  CHECK(fault_with("wind_m_s", R"({"uniform": [3, 70]})") ==
        "night.json: weather.wind_m_s.uniform[1] = 70 m/s; expected at least 0 and at most 60 m/s");
  CHECK(fault_with("wind_m_s", R"({"uniform": 3})") ==
        "night.json: weather.wind_m_s.uniform = 3; expected [lowest, highest], two numbers");
  CHECK(fault_with("wind_m_s", R"({"normal": [3, -1]})") ==
        "night.json: weather.wind_m_s.normal[1] = -1; expected a standard deviation of at least 0");
  CHECK(fault_with("wind_m_s", R"({"normal": [-9, 1]})") ==
        "night.json: weather.wind_m_s.normal = [-9,1]; expected one of a hundred draws to be at least 0 and "
        "at most "
        "60 m/s");
  CHECK(fault_with("wind_m_s", R"({"choice": []})") ==
        "night.json: weather.wind_m_s.choice = []; expected a list of at least one entry");
  CHECK(fault_with("wind_m_s", R"({"choice": [1, 70]})") ==
        "night.json: weather.wind_m_s.choice[1] = 70 m/s; expected at least 0 and at most 60 m/s");
  CHECK(fault_with("wind_m_s", R"({"choice": [1, 2], "weights": [1]})") ==
        "night.json: weather.wind_m_s.weights = [1]; expected 2 numbers of at least 0, one above 0");
  CHECK(fault_with("wind_m_s", R"({"choice": [1, {"uniform": [5, 4]}]})") ==
        "night.json: weather.wind_m_s.choice[1].uniform = [5,4]; expected the lowest first");
  CHECK(fault_with("wind_m_s", R"({"uniform": [1, 2], "normal": [1, 2]})") ==
        "night.json: weather.wind_m_s = uniform, normal; expected one of uniform, normal or choice");
  CHECK(fault_with("time", R"({"uniform": ["18:00", "25:00"]})") ==
        "night.json: weather.time.uniform[1] = \"25:00\"; expected text that matches "
        "^([01][0-9]|2[0-3]):[0-5][0-9]$");
  CHECK(fault_with("date", R"({"uniform": ["2026-07-09", "2026-02-30"]})") ==
        "night.json: weather.date.uniform[1] = \"2026-02-30\"; expected a day of the calendar");
  CHECK(fault_with("air_hourly_k", R"({"uniform": [1, 2]})") ==
        "night.json: weather.air_hourly_k.uniform = [1,2]; expected choice, for what is not a number");
}

TEST_CASE("Flights draw a row of a file of views") {
  const TestFolder folder;
  const Path file =
      folder.file("views.csv", "# real flights\nlook_angle_deg, altitude_m,weight\r\n30,60,0\n45,90,1\n");
  Json document = night();
  document["clips"][0]["flight"]["views"] = {{"file", file.string()}};
  const ResolvedConfig config = resolved(document);
  const Json& flight = config.document["clips"][0]["flight"];
  CHECK(flight["altitude_m"] == 90);
  CHECK(flight["look_angle_deg"] == 45);
  CHECK(flight["speed_m_s"] == 12);
  CHECK_FALSE(flight.contains("views"));
  CHECK(config.document["clips"][0]["drawn"] == parse_json(R"(["flight.views"])", ""));
  document["clips"][0]["flight"]["altitude_m"] = 50;
  CHECK(fault_in(document) ==
        "night.json: clips[0].flight.altitude_m = 50 m; expected none beside flight.views");
}

TEST_CASE("Faults of a file of views name its lines") {
  const TestFolder folder;
  const auto fault_of = [&](const std::string& text) {
    const Path file = folder.file("views.csv", text);
    Json document = night();
    document["clips"][0]["flight"]["views"] = {{"file", file.string()}};
    const std::string start = "night.json: clips[0].flight.views: " + file.string();
    const std::string message = fault_in(document);
    REQUIRE_THAT(message, StartsWith(start));
    return message.substr(start.size());
  };
  CHECK(fault_of("altitude_m\n") == ":1: the column look_angle_deg is missing; expected it in the first row");
  CHECK(fault_of("altitude_m,look_angel_deg\n") ==
        ":1 = \"look_angel_deg\"; expected a column of altitude_m, look_angle_deg, speed_m_s, weight; did "
        "you mean "
        "\"look_angle_deg\"?");
  CHECK(fault_of("altitude_m,look_angle_deg\n60,120\n") ==
        ":2: look_angle_deg = 120 deg; expected at least 1 and at most 90 deg");
  CHECK(fault_of("altitude_m,look_angle_deg\n60\n") ==
        ":2 = \"60\"; expected 2 numbers: altitude_m,look_angle_deg");
  CHECK(fault_of("altitude_m,look_angle_deg\n60,x\n") == ":2: look_angle_deg = \"x\"; expected a number");
  CHECK(fault_of("altitude_m,look_angle_deg,weight\n60,40,0\n") ==
        ": no view with a weight above 0; expected at least one");
}

}  // namespace draws_test
