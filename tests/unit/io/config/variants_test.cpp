#include "io/config/variants.h"

#include "base/error.h"
#include "support/assets.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace variants_test {

using namespace thermal;

namespace {

std::vector<Variant> variants_in(const std::string& text) {
  return read_variants(parse_json(text, "list.json"), "list.json", kAssets);
}

std::string fault_in(const std::string& text) {
  return message_of<ConfigError>([&] { (void)variants_in(text); });
}

/// The resulting document with one variant's changes.
Json changed(const std::string& changes, const std::string& document) {
  const Variant variant = {.name = "x", .where = "", .changes = parse_json(changes, "")};
  return changed_by(variant, parse_json(document, ""));
}

}  // namespace

TEST_CASE("Variants are in order, each with its prefix for messages") {
  const auto variants = variants_in(R"({"variants": [{"name": "plain"}, {"name": "B-2_x", "seed": 3}]})");
  REQUIRE(variants.size() == 2);
  CHECK(variants[0].name == "plain");
  CHECK(variants[0].changes == Json::object());
  CHECK(variants[1].name == "B-2_x");
  CHECK(variants[1].where == "list.json: variants[1] (B-2_x)");
  CHECK(variants[1].changes == Json{{"seed", 3}});
}

TEST_CASE("Objects are merged key by key, anything else is replaced") {
  CHECK(changed(R"({"sensor": {"agc": {"mode": "plateau"}, "preset": "new"}, "terms": {"sky": "off"}})",
                R"({"seed": 1, "sensor": {"agc": {"mode": "linear", "low_k": 250}, "netd_mk": 30}})") ==
        parse_json(R"({"seed": 1, "sensor": {"agc": {"mode": "plateau", "low_k": 250}, "netd_mk": 30,
                       "preset": "new"}, "terms": {"sky": "off"}})",
                   ""));
  CHECK(changed(R"({"seed": 2, "camera": {"distortion": {"k1": 0.1}}})",
                R"({"seed": 1, "camera": {"width_px": 9, "distortion": {"k1": 0.5, "p1": 0.2}}})") ==
        parse_json(R"({"seed": 2, "camera": {"width_px": 9, "distortion": {"k1": 0.1, "p1": 0.2}}})", ""));
}

TEST_CASE("A season applies to every clip") {
  const char* const clips =
      R"({"clips": [{"id": "a", "season": "winter"}, {"id": "b", "season": "summer"}]})";
  CHECK(changed(R"({"season": "summer"})", clips) ==
        parse_json(R"({"clips": [{"id": "a", "season": "summer"}, {"id": "b", "season": "summer"}]})", ""));
  CHECK(changed("{}", clips) == parse_json(clips, ""));
}

TEST_CASE("Invalid lists are errors") {
  CHECK(fault_in(R"({"variants": []})") == "list.json: variants = a list of 0; expected at least 1 entries");
  CHECK(fault_in("{}") == "list.json: variants is missing; expected a value");
  CHECK(fault_in(R"({"variants": [{"seed": 3}]})") ==
        "list.json: variants[0].name is missing; expected a value");
  CHECK(
      fault_in(R"({"variants": [{"name": "a/b"}, {"name": ""}]})") ==
      "list.json: variants[0].name = \"a/b\"; expected 1 to 200 letters, digits, _ or -, not beginning with "
      "-\n"
      "list.json: variants[1].name = \"\"; expected 1 to 200 letters, digits, _ or -, not beginning with -");
  CHECK(fault_in(R"({"variants": [{"name": "a"}, {"name": "b"}, {"name": "a"}]})") ==
        "list.json: variants[2].name = \"a\"; expected each name once");
  CHECK(fault_in(R"({"variants": [{"name": "a", "sensr": {}}]})") ==
        "list.json: variants[0].sensr is not a known key; expected one of name, season, seed, weather, "
        "sensor, output, terms, camera; did you mean \"sensor\"?");
  CHECK(fault_in(R"({"variants": [{"name": "a", "camera": {"width_px": 320}}]})") ==
        "list.json: variants[0].camera.width_px is not a known key; expected one of distortion");
  CHECK(fault_in(R"({"variants": [{"name": "a", "sensor": "boson"}]})") ==
        "list.json: variants[0].sensor = \"boson\"; expected an object");
  CHECK(fault_in(R"({"variants": [{"name": "a", "season": "spring"}]})") ==
        "list.json: variants[0].season = \"spring\"; expected one of winter, summer");
}

}  // namespace variants_test
