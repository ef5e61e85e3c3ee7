#include "io/config/config.h"

#include "base/error.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace config_test {

using namespace thermal;

namespace {

/// A minimal config.
Json least() {
  return parse_json(R"({"name": "night", "clips": [
      {"id": "a", "season": "winter", "frames": 3, "flight": {"pattern": "zigzag"}},
      {"id": "b", "season": "summer", "frames": 4, "flight": {"pattern": "zigzag"}}]})",
                    "");
}

/// The same with a flight to cut.
Json with_flight() {
  Json document = least();
  document["flights"] = parse_json(
      R"([{"id": "long", "season": "winter", "duration_s": 60, "flight": {"pattern": "zigzag"}}])", "");
  return document;
}

ResolvedConfig resolved(const Json& document) { return resolve_config(document, "night.json", kAssets); }

std::string fault_in(const Json& document) {
  return message_of<ConfigError>([&] { (void)resolved(document); });
}

Json with_setting(const std::string& assignment) {
  Json document = least();
  apply_setting(document, assignment);
  return document;
}

std::string fault_in_setting(const std::string& assignment) {
  return message_of<ConfigError>([&] { (void)with_setting(assignment); });
}

}  // namespace

TEST_CASE("The ray caster draws what the config leaves open, but for passes that extend beyond the picture") {
  const ResolvedConfig open = resolved(least());
  CHECK(open.spec.engine == Engine::embree);
  CHECK(open.spec.engine_reason == "the ray caster, which draws all of this config");
  CHECK(open.document["render"]["engine"] == "embree");
  CHECK(resolved(with_setting("render.overscan_px=0")).spec.engine == Engine::embree);
  const ResolvedConfig wide = resolved(with_setting("render.overscan_px=8"));
  CHECK(wide.spec.engine == Engine::blender);
  CHECK(wide.spec.engine_reason ==
        "because of render.overscan_px = 8 px: embree draws nothing beyond the picture");
  CHECK(wide.document["render"]["engine"] == "blender");
  for (const char* name : {"blender", "embree"}) {
    const ResolvedConfig named = resolved(with_setting(std::string("render.engine=") + name));
    CHECK(named.document["render"]["engine"] == name);
    CHECK(named.spec.engine_reason.empty());
  }
  for (const ResolvedConfig& chosen : {open, wide}) {
    const ResolvedConfig again = resolved(chosen.document);
    CHECK(again.document == chosen.document);
    CHECK(again.spec.engine_reason.empty());
  }
}

TEST_CASE("Sampling follows the engine that was chosen") {
  Json physical = with_setting("sensor.model=physical");
  physical["sensor"]["netd_mk"] = 40;
  CHECK(resolved(physical).spec.adaptive_sampling);
  CHECK_FALSE(resolved(least()).spec.adaptive_sampling);  // the published model has one sample a pixel
  physical["render"]["overscan_px"] = 8;
  CHECK_FALSE(resolved(physical).spec.adaptive_sampling);
  CHECK(resolved(physical).spec.supersample == 4);
  physical["render"]["sampling"] = "adaptive";
  CHECK(fault_in(physical) ==
        R"(night.json: render.sampling = "adaptive"; expected "full", or render.engine = "embree")");
}

TEST_CASE("What was made by another engine is continued with that one") {
  const Json here = resolved(least()).document;
  const Json there = resolved(with_setting("render.engine=blender")).document;
  CHECK(expected_config(here, there) == "the same config with --set render.engine=blender");
  CHECK(expected_config(here, here) == "the same config");
  CHECK(expected_config(here, resolved(with_setting("seed=2")).document) == "the same config");
  CHECK(expected_config(here, Json::object()) == "the same config");
  CHECK(expected_config(here, {{"render", {{"engine", 3}}}}) == "the same config");
}

TEST_CASE("A minimal config is valid, and all defaults are filled in") {
  const ResolvedConfig config = resolved(least());
  CHECK(config.spec.name == "night");
  CHECK(config.spec.seed == 1);
  CHECK(config.spec.width_px == 640);
  CHECK(config.spec.height_px == 512);
  REQUIRE(config.spec.clips.size() == 2);
  CHECK(config.spec.clips[1].id == "b");
  CHECK(config.spec.clips[1].season == Season::summer);
  CHECK(config.spec.clips[1].frames == 4);
  CHECK(config.spec.clips[1].frame_rate_hz == 9);
  CHECK(config.document["sensor"]["kelvin_per_count"] == 0.01);
  CHECK(config.document["clips"][0]["flight"]["altitude_m"] == 61);
}

TEST_CASE("Label thresholds are read, and are nearly off by default") {
  CHECK(resolved(least()).spec.settings->labels == LabelParameters());
  Json document = least();
  document["labels"] = {
      {"occluded_below_visibility", 0.5}, {"ignore_below_visibility", 0.25}, {"ignore_below_area_px", 12}};
  CHECK(resolved(document).spec.settings->labels == LabelParameters{.occluded_below_visibility = 0.5,
                                                                    .ignore_below_visibility = 0.25,
                                                                    .ignore_below_area_px = 12});
}

TEST_CASE("Resolving a resolved config changes nothing") {
  const ResolvedConfig config = resolved(least());
  CHECK(resolved(config.document).document == config.document);
}

TEST_CASE("Every fault has a line starting with the config's name") {
  Json document = least();
  document["clips"][0]["frames"] = 0;
  document["clips"][1]["flight"]["patern"] = "follow";
  document["camera"]["width_px"] = "640";
  CHECK_THAT(
      fault_in(document),
      StartsWith("night.json: clips[0].frames = 0; expected at least 1 and at most 1000000\n"
                 "night.json: clips[1].flight.patern is not a known key; expected one of pattern, ") &&
          EndsWith("; did you mean \"pattern\"?\nnight.json: camera.width_px = \"640\"; expected a whole "
                   "number"));
}

TEST_CASE("Clip ids are unique") {
  CHECK(fault_in(with_setting("clips[1].id=a")) == "night.json: clips[1].id = \"a\"; expected each id once");
}

TEST_CASE("A setting changes one value, as JSON or as plain text") {
  CHECK(with_setting("seed=7")["seed"] == 7);
  CHECK(with_setting("name=other")["name"] == "other");
  CHECK(with_setting("name=\"7\"")["name"] == "7");
  CHECK(with_setting("clips[1].flight.altitude_m=30.5")["clips"][1]["flight"]["altitude_m"] == 30.5);
  CHECK(with_setting("sensor.netd_mk=50")["sensor"]["netd_mk"] == 50);  // creates missing members on the way
  CHECK(with_setting("name=a=b")["name"] == "a=b");
  CHECK(with_setting("name=")["name"].get<std::string>().empty());
}

TEST_CASE("The season setting applies to every clip") {
  const Json document = with_setting("season=summer");
  CHECK(document["clips"][0]["season"] == "summer");
  CHECK(document["clips"][1]["season"] == "summer");
}

TEST_CASE("An invalid setting is an error") {
  CHECK(fault_in_setting("seed") == "--set = \"seed\"; expected KEY=VALUE");
  CHECK(fault_in_setting("=7") == "--set = \"=7\"; expected KEY=VALUE");
  CHECK(fault_in_setting("name.first=7") ==
        "--set = \"name.first=7\"; expected KEY=VALUE with the key of an object");
  CHECK(fault_in_setting("sensor..x=7") ==
        "--set = \"sensor..x=7\"; expected KEY=VALUE with the key of an object");
  CHECK(fault_in_setting("clips.0.id=c") ==
        "--set = \"clips.0.id=c\"; expected an entry of a list in brackets, such as clips[0].frames=8");
  CHECK(fault_in_setting("clips[2].id=c") ==
        "--set = \"clips[2].id=c\"; expected an entry of clips, [0] to [1]");
  CHECK(fault_in_setting("clips[x].id=c") ==
        "--set = \"clips[x].id=c\"; expected an entry of clips, [0] to [1]");
  CHECK(fault_in_setting("clips[].id=c") ==
        "--set = \"clips[].id=c\"; expected an entry of clips, [0] to [1]");
}

TEST_CASE("A setting's value is checked like any other") {
  CHECK(fault_in(with_setting("sensor.optics.blur_sigma_px=-1")) ==
        "night.json: sensor.optics.blur_sigma_px = -1 px; expected at least 0 and at most 10 px");
}

TEST_CASE("An unknown clip is an error with the nearest id") {
  Json document = least();
  document["clips"][0]["id"] = "winter_zigzag";
  const ResolvedConfig config = resolved(document);
  CHECK(config.spec.clip("b", "--clips").frames == 4);
  CHECK(message_of<ConfigError>([&] { (void)config.spec.clip("winter_zigzg", "--clips"); }) ==
        "--clips = \"winter_zigzg\"; expected one of winter_zigzag, b; did you mean \"winter_zigzag\"?");
}

TEST_CASE("Maps are relative to the config that names them") {
  Json document = least();
  document["scene"]["terrain"]["heightmap"] = {{"file", "maps/hill.png"}, {"height_m", {0, 30}}};
  document["scene"]["terrain"]["density_map"] = {{"file", "/abroad/areas.png"}};
  root_files(document, "/ranger");
  const Json terrain = resolved(document).document["scene"]["terrain"];
  CHECK(terrain["heightmap"]["file"] == "/ranger/maps/hill.png");
  CHECK(terrain["density_map"]["file"] == "/abroad/areas.png");
}

TEST_CASE("A map that is not a file name is left to the schema") {
  Json document = least();
  document["scene"]["terrain"]["density_map"] = {{"file", 3}};
  root_files(document, "/ranger");
  CHECK(fault_in(document) == "night.json: scene.terrain.density_map.file = 3; expected a string");
}

TEST_CASE("A mission's file is relative to the config, for clips and for flights") {
  Json document = with_flight();
  document["clips"][0]["flight"] = {{"pattern", "waypoints"}, {"waypoints", {{"file", "lake.plan"}}}};
  document["flights"][0]["flight"] = {{"pattern", "waypoints"}, {"waypoints", {{"file", "/abroad/log.csv"}}}};
  root_files(document, "/ranger");
  const Json found = resolved(document).document;
  CHECK(found["clips"][0]["flight"]["waypoints"]["file"] == "/ranger/lake.plan");
  CHECK(found["flights"][0]["flight"]["waypoints"]["file"] == "/abroad/log.csv");
}

TEST_CASE("A view is shorthand for a height and an angle, which can be overridden") {
  Json document = least();
  document["clips"][0]["flight"] = {{"pattern", "zigzag"}, {"view", "122m_oblique"}};
  document["clips"][1]["flight"] = {{"pattern", "zigzag"}, {"view", "122m_oblique"}, {"look_angle_deg", 60}};
  const Json clips = resolved(document).document["clips"];
  CHECK(clips[0]["flight"]["altitude_m"] == 122);
  CHECK(clips[0]["flight"]["look_angle_deg"] == 45);
  CHECK(clips[1]["flight"]["altitude_m"] == 122);
  CHECK(clips[1]["flight"]["look_angle_deg"] == 60);
}

TEST_CASE("A setting whose value is not valid JSON is a string") {
  const std::string deep(100, '[');
  CHECK(with_setting("name=" + deep + std::string(100, ']'))["name"].is_string());
  CHECK(with_setting(R"(name={"a": 1, "a": 2})")["name"] == R"({"a": 1, "a": 2})");
}

TEST_CASE("A config of flights needs no clips, and one with neither is an error") {
  Json document = with_flight();
  document.erase("clips");
  CHECK(resolved(document).spec.clips.empty());
  document.erase("flights");
  CHECK(fault_in(document) == "night.json: clips and flights are empty; expected at least one of either");
}

TEST_CASE("Flight ids are unique") {
  Json document = with_flight();
  document["flights"].push_back(document["flights"][0]);
  CHECK(fault_in(document) == "night.json: flights[1].id = \"long\"; expected each id once");
}

TEST_CASE("The season setting applies to every flight as well") {
  Json document = with_flight();
  apply_setting(document, "season=summer");
  CHECK(document["flights"][0]["season"] == "summer");
}

TEST_CASE("An entry that is neither clip nor flight has no season, and is still reported") {
  Json document = least();
  document["clips"] = {"a", document["clips"][0]};
  document["flights"] = "b";
  apply_setting(document, "season=summer");
  CHECK(document["clips"][0] == "a");
  CHECK(document["clips"][1]["season"] == "summer");
  CHECK_THAT(fault_in(document), StartsWith("night.json: "));
}

TEST_CASE("The clips of flights follow a config's own") {
  const ResolvedConfig config = resolved(with_flight());
  std::vector<ClipSpec> clips = config.spec.clips;
  clips.push_back(config.spec.flight("long")->cut({.id = "long_0000", .frames = 7, .start_s = 2}));
  const ResolvedConfig cut = with_clips(config, clips);
  REQUIRE(cut.spec.clips.size() == 3);
  CHECK(cut.spec.clips[2].season == Season::winter);
  CHECK(cut.spec.clips[2].settings == config.spec.flights[0].settings);
  CHECK(cut.spec.flights.empty());
  CHECK(cut.document["clips"][1] == config.document["clips"][1]);
  Json clip = {
      {"id", "long_0000"}, {"start_s", 2.0}, {"frames", 7}, {"frame_rate_hz", 9.0}, {"of_flight", "long"}};
  clip.update({{"season", "winter"}, {"flight", config.document["flights"][0]["flight"]}});
  CHECK(cut.document["clips"][2] == clip);
  CHECK(cut.document["flights"].empty());
  CHECK(resolved(cut.document).document == cut.document);
}

TEST_CASE("8-bit frames pass through a codec only if the config names one, with its bit rate") {
  CHECK(resolved(least()).spec.settings->codec == std::nullopt);
  CHECK_FALSE(resolved(least()).document.contains("output"));
  Json document = least();
  document["output"] = {{"codec", {{"name", "mpeg4"}, {"bitrate_kbit_s", 800}}}};
  const ResolvedConfig config = resolved(document);
  CHECK(config.spec.settings->codec == VideoCodecSettings{.name = "mpeg4", .bitrate_kbit_s = 800});
  CHECK(config.document["output"] == document["output"]);
  document["output"]["codec"]["name"] = "h265";
  CHECK(fault_in(document) ==
        "night.json: output.codec.name = \"h265\"; expected one of h264, mpeg4, mjpeg; did you mean "
        "\"h264\"?");
  document["output"]["codec"] = {{"name", "h264"}};
  CHECK(fault_in(document) == "night.json: output.codec.bitrate_kbit_s is missing; expected a value");
}

}  // namespace config_test
