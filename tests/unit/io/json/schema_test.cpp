#include "io/json/schema.h"

#include <thread>

#include "support/catch.h"

namespace json_schema_test {

using namespace thermal;

namespace {

using Faults = std::vector<std::string>;

/// A schema with a member of every kind.
const Json kSchema = parse_json(R"({
  "type": "object",
  "additionalProperties": false,
  "required": ["name"],
  "properties": {
    "name": {"type": "string", "pattern": "^[A-Za-z0-9_][A-Za-z0-9_-]{0,199}$"},
    "code": {"type": "string", "pattern": "^x"},
    "frames": {"type": "integer", "minimum": 1, "maximum": 100},
    "speed_m_s": {"type": "number", "exclusiveMinimum": 0, "maximum": 30},
    "tilt_deg": {"type": "number", "minimum": -90},
    "loud": {"type": "boolean"},
    "season": {"type": "string", "enum": ["winter", "summer"]},
    "version": {"type": "integer", "enum": [1]},
    "area_m": {"type": "array", "minItems": 4, "maxItems": 4, "items": {"type": "number"}},
    "clips": {"type": "array", "minItems": 1, "maxItems": 3, "items": {
      "type": "object", "required": ["id"], "properties": {"id": {"type": "string"},
                                                           "frames": {"type": "integer", "default": 9}}}},
    "paths": {"type": "object", "additionalProperties": {"type": "object", "additionalProperties": false,
      "properties": {"length_m": {"type": "number", "default": 5}}}},
    "sensor": {"type": "object", "default": {}, "properties": {
      "preset": {"type": "string", "default": "airsim_w"},
      "noise": {"type": "object", "default": {}, "properties": {"stddev_dn": {"type": "number", "default": 2}}}}},
    "spacing_m": {"type": ["number", "array"], "exclusiveMinimum": 0, "maxItems": 2, "items": {"type": "number", "minimum": 0}},
    "view": {"type": "string", "presets": {"low": {"frames": 3, "season": "winter"}}},
    "first": {"$ref": "#/$defs/leg"},
    "later": {"type": "array", "items": {"$ref": "#/$defs/leg"}},
    "free": {"type": "object"}
  },
  "$defs": {"leg": {"type": "object", "required": ["to"], "properties": {"to": {"type": "string"},
                                                                          "turn_deg": {"type": "number", "default": 4}}}}
})",
                                "schema");

/// Faults of a document with a name and `members`.
Faults faults_in(const std::string& members) {
  Json document = parse_json(R"({"name": "n")" + (members.empty() ? "" : ", " + members) + "}", "document");
  return check_and_fill(document, kSchema);
}

}  // namespace

TEST_CASE("A valid document has no faults") {
  CHECK(faults_in("").empty());
  CHECK(faults_in(R"("frames": 100, "speed_m_s": 0.1, "tilt_deg": -90, "loud": true, "season": "summer",
                     "version": 1, "code": "x1", "area_m": [0, 0, 1, 1], "clips": [{"id": "a"}],
                     "paths": {"any name": {}}, "free": {"what": "ever"})")
            .empty());
}

TEST_CASE("An unknown key is reported with the known ones and the nearest") {
  Json document = parse_json(R"({"lenght_m": 1})", "");
  CHECK(check_and_fill(document, kSchema["properties"]["paths"]["additionalProperties"]) ==
        Faults{"lenght_m is not a known key; expected one of length_m; did you mean \"length_m\"?"});
  CHECK(faults_in(R"("paths": {"loop": {"width": 1}})") ==
        Faults{"paths.loop.width is not a known key; expected one of length_m"});
  CHECK_THAT(faults_in(R"("seson": "winter")").at(0),
             StartsWith("seson is not a known key; expected one of name, code, ") &&
                 EndsWith("; did you mean \"season\"?"));
}

TEST_CASE("A missing key is reported") {
  Json document = Json::object();
  CHECK(check_and_fill(document, kSchema) == Faults{"name is missing; expected a value"});
  CHECK(faults_in(R"("clips": [{"id": "a"}, {}])") == Faults{"clips[1].id is missing; expected a value"});
}

TEST_CASE("A value of the wrong type is reported with the right types") {
  CHECK(faults_in(R"("frames": "12")") == Faults{"frames = \"12\"; expected a whole number"});
  CHECK(faults_in(R"("frames": 1.5)") == Faults{"frames = 1.5; expected a whole number"});
  CHECK(faults_in(R"("speed_m_s": null)") == Faults{"speed_m_s = null; expected a number"});
  CHECK(faults_in(R"("loud": 1)") == Faults{"loud = 1; expected true or false"});
  CHECK(faults_in(R"("code": 7)") == Faults{"code = 7; expected a string"});
  CHECK(faults_in(R"("clips": {"id": "a"})") == Faults{"clips = an object; expected a list"});
  CHECK(faults_in(R"("sensor": [1, 2])") == Faults{"sensor = a list of 2; expected an object"});
  Json list = Json::array();
  CHECK(check_and_fill(list, kSchema) == Faults{"document = a list of 0; expected an object"});
}

TEST_CASE("A value may be of several types, each with its own rules") {
  CHECK(faults_in(R"("spacing_m": 0.5)").empty());
  CHECK(faults_in(R"("spacing_m": [0, 2])").empty());
  CHECK(faults_in(R"("spacing_m": "2")") == Faults{"spacing_m = \"2\"; expected a number or a list"});
  CHECK(faults_in(R"("spacing_m": 0)") == Faults{"spacing_m = 0 m; expected more than 0 m"});
  CHECK(faults_in(R"("spacing_m": [1, -1])") == Faults{"spacing_m[1] = -1 m; expected at least 0 m"});
  CHECK(faults_in(R"("spacing_m": [1, 1, 1])") ==
        Faults{"spacing_m = a list of 3; expected at most 2 entries"});
}

TEST_CASE("A whole number may be written with a decimal point") {
  CHECK(faults_in(R"("frames": 12.0)").empty());
  CHECK(faults_in(R"("frames": 1e300)") ==
        Faults{"frames = 1e+300; expected a whole number"});  // too large for a double to count by one
}

TEST_CASE("A value out of range is reported with its unit and the whole rule") {
  CHECK(faults_in(R"("speed_m_s": 0)") ==
        Faults{"speed_m_s = 0 m/s; expected more than 0 and at most 30 m/s"});
  CHECK(faults_in(R"("speed_m_s": 31.5)") ==
        Faults{"speed_m_s = 31.5 m/s; expected more than 0 and at most 30 m/s"});
  CHECK(faults_in(R"("tilt_deg": -91)") == Faults{"tilt_deg = -91 deg; expected at least -90 deg"});
  CHECK(faults_in(R"("frames": 0)") == Faults{"frames = 0; expected at least 1 and at most 100"});
  CHECK(faults_in(R"("frames": 101)") == Faults{"frames = 101; expected at least 1 and at most 100"});
}

TEST_CASE("A value that is not among the choices is reported with the nearest") {
  CHECK(faults_in(R"("season": "sumer")") ==
        Faults{"season = \"sumer\"; expected one of winter, summer; did you mean \"summer\"?"});
  CHECK(faults_in(R"("season": "Autumn")") == Faults{"season = \"Autumn\"; expected one of winter, summer"});
  CHECK(faults_in(R"("version": 2)") == Faults{"version = 2; expected 1"});
}

TEST_CASE("A string that does not match is reported in words, or with the pattern") {
  Json document = parse_json(R"({"name": "two words"})", "");
  CHECK(check_and_fill(document, kSchema) ==
        Faults{"name = \"two words\"; expected 1 to 200 letters, digits, _ or -, not beginning with -"});
  for (const std::string& name :
       {std::string("-rf"), std::string(), std::string("a/b"), std::string(".."), std::string(201, 'a')}) {
    Json other = {{"name", name}};
    CHECK(check_and_fill(other, kSchema) ==
          Faults{"name = " + brief(other["name"]) +
                 "; expected 1 to 200 letters, digits, _ or -, not beginning with -"});
  }
  Json longest = {{"name", std::string(200, 'a')}};
  CHECK(check_and_fill(longest, kSchema).empty());
  Json endless = {{"name", std::string(1 << 20, 'a')}};
  CHECK(check_and_fill(endless, kSchema) ==
        Faults{"name = \"" + std::string(59, 'a') + "…; expected at most 4096 bytes"});
  CHECK(faults_in(R"("code": "y")") == Faults{"code = \"y\"; expected text that matches ^x"});
}

// Patterns of characters that are in no other one: ThreadSanitizer sees two threads compile them at first.
TEST_CASE("Two threads may match a pattern at the same time") {
  const Json schema = parse_json(R"({"type": "string", "pattern": "^[~%&!]"})", "schema");
  const auto faults_of = [&schema](const char* text) {
    Json document = text;
    return check_and_fill(document, schema);
  };
  Faults none;
  std::thread other([&] { none = faults_of("~"); });
  const Faults one = faults_of("a");
  other.join();
  CHECK(none.empty());
  CHECK(one == Faults{R"(document = "a"; expected text that matches ^[~%&!])"});
}

TEST_CASE("A list that is too short or too long is reported") {
  CHECK(faults_in(R"("area_m": [1, 2, 3])") == Faults{"area_m = a list of 3; expected 4 entries"});
  CHECK(faults_in(R"("clips": [])") == Faults{"clips = a list of 0; expected at least 1 entries"});
  CHECK(faults_in(R"("clips": [{"id": "a"}, {"id": "b"}, {"id": "c"}, {"id": "d"}])") ==
        Faults{"clips = a list of 4; expected at most 3 entries"});
}

TEST_CASE("Faults inside lists are reported by entry, and all of them at once") {
  CHECK(faults_in(R"("area_m": [0, "1", 2, true], "frames": -1)") ==
        Faults{"area_m[1] = \"1\"; expected a number", "area_m[3] = true; expected a number",
               "frames = -1; expected at least 1 and at most 100"});
}

TEST_CASE("A long value is shortened in its message") {
  const std::string fault = faults_in("\"season\": \"" + std::string(200, 'w') + "\"").at(0);
  CHECK(fault == "season = \"" + std::string(59, 'w') + "…; expected one of winter, summer");
}

TEST_CASE("Defaults are filled in at every depth, and existing values stay") {
  Json document = parse_json(R"({"name": "n", "clips": [{"id": "a"}, {"id": "b", "frames": 4}],
                                 "paths": {"loop": {}}})",
                             "");
  REQUIRE(check_and_fill(document, kSchema).empty());
  CHECK(document["sensor"].dump() == R"({"preset":"airsim_w","noise":{"stddev_dn":2}})");
  CHECK(document["clips"][0]["frames"] == 9);
  CHECK(document["clips"][1]["frames"] == 4);
  CHECK(document["paths"]["loop"]["length_m"] == 5);
  CHECK_FALSE(document.contains("frames"));  // no default
}

TEST_CASE("Filling in defaults twice changes nothing") {
  Json once = parse_json(R"({"name": "n", "sensor": {"preset": "other"}})", "");
  REQUIRE(check_and_fill(once, kSchema).empty());
  Json twice = once;
  REQUIRE(check_and_fill(twice, kSchema).empty());
  CHECK(twice.dump() == once.dump());
}

TEST_CASE("The unit is that of the longest matching suffix") {
  CHECK(unit_of_key("speed_m_s") == "m/s");
  CHECK(unit_of_key("start_s") == "s");
  CHECK(unit_of_key("size_m") == "m");
  CHECK(unit_of_key("pixel_pitch_um") == "um");
  CHECK(unit_of_key("lens_mm") == "mm");
  CHECK(unit_of_key("netd_mk") == "mK");
  CHECK(unit_of_key("radiance_w_m2_sr") == "W m^-2 sr^-1");
  CHECK(unit_of_key("per_ha") == "per hectare");
  CHECK(unit_of_key("seed").empty());
  CHECK(unit_of_key("").empty());
}

TEST_CASE("Faults of entries with one name are one fault") {
  const Json schema = parse_json(
      R"({"type": "object", "properties": {"clips": {"type": "array", "items": {"type": "object",
          "properties": {"speed_m_s": {"type": "number"}}}}}})",
      "");
  Json document =
      parse_json(R"({"clips": [{"speed_m_s": "a"}, {"speed_m_s": "b"}, {"speed_m_s": "c"}]})", "");
  CHECK(check_and_fill(document, schema, "", {{"clips", {"clips[0]", "the others", "the others"}}}) ==
        std::vector<std::string>{"clips[0].speed_m_s = \"a\"; expected a number",
                                 "the others.speed_m_s = \"b\"; expected a number"});
}

TEST_CASE("A schema's references are resolved, checked and filled in") {
  CHECK(faults_in(R"("first": {"turn_deg": "x"}, "later": [{"to": "a"}, {}])") ==
        Faults{"first.turn_deg = \"x\"; expected a number", "first.to is missing; expected a value",
               "later[1].to is missing; expected a value"});
  Json document = parse_json(R"({"name": "n", "later": [{"to": "a"}]})", "");
  CHECK(check_and_fill(document, kSchema).empty());
  CHECK(document["later"][0]["turn_deg"] == 4);
}

TEST_CASE("A preset fills in what is not given, and no more") {
  Json document = parse_json(R"({"name": "n", "view": "low", "frames": 8})", "");
  CHECK(check_and_fill(document, kSchema).empty());
  CHECK(document["frames"] == 8);
  CHECK(document["season"] == "winter");
  Json unknown = parse_json(R"({"name": "n", "view": "high"})", "");
  CHECK(check_and_fill(unknown, kSchema).empty());
  CHECK_FALSE(unknown.contains("frames"));
}

}  // namespace json_schema_test
