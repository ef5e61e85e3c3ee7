#include "io/json/file.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace json_file_test {

using namespace thermal;

namespace {

std::string fault_in(const std::string& text) {
  return message_of<ConfigError>([&] { (void)parse_json(text, "night.json"); });
}

}  // namespace

TEST_CASE("JSON keeps its keys in order, and its numbers' kinds") {
  const Json json = parse_json(R"({"z": 1, "a": 2.0, "m": [true, null]})", "night.json");
  CHECK(json.dump() == R"({"z":1,"a":2.0,"m":[true,null]})");
  CHECK(to_text(json) == "{\n  \"z\": 1,\n  \"a\": 2.0,\n  \"m\": [\n    true,\n    null\n  ]\n}\n");
}

TEST_CASE("Invalid JSON is reported with line and column") {
  CHECK_THAT(fault_in("{\n  \"a\": 1,\n  \"b\": oops\n}"),
             StartsWith("night.json:3:8: not JSON: syntax error while parsing value - invalid literal"));
  CHECK_THAT(fault_in("{\"a\": 1,}"),
             StartsWith("night.json:1:9: not JSON: syntax error while parsing object key - unexpected '}'"));
  CHECK_THAT(fault_in("{\"a\": 1"),
             StartsWith("night.json:1:8: not JSON: syntax error while parsing object"));
  CHECK(fault_in("") == "night.json:1:1: not JSON: it is empty");
  CHECK_THAT(fault_in("[NaN]"),
             EndsWith("; expected a finite number: JSON has no NaN and no Infinity, though "
                      "Python writes them"));
  CHECK(fault_in("[1e999]") == "night.json: not JSON: number overflow parsing '1e999'");
  CHECK_THAT(fault_in("{}\n{}"), StartsWith("night.json:2:1: not JSON: syntax error"));
}

TEST_CASE("A repeated key in one object is an error, not a silent choice") {
  CHECK(fault_in(R"({"a": 1, "b": {"c": 1, "c": 2}})") ==
        "night.json: key \"c\" appears twice in one object; expected once");
  CHECK_NOTHROW(parse_json(R"({"a": {"c": 1}, "b": [{"c": 2}, {"c": 3}]})", "night.json"));
}

TEST_CASE("Lists and objects may be nested 64 deep and no deeper") {
  const auto nested = [](std::size_t depth) {
    return R"({"a":)" + std::string(depth - 1, '[') + std::string(depth - 1, ']') + "}";
  };
  CHECK_NOTHROW(parse_json(nested(64), "night.json"));
  const std::string expected = "night.json: lists and objects are nested more than 64 deep; expected fewer";
  CHECK(fault_in(nested(65)) == expected);
  CHECK(fault_in(nested(300'000)) == expected);
  CHECK(fault_in(std::string(300'000, '[')) == expected);
}

TEST_CASE("A file read element by element has the same faults as one read at once") {
  const TestFolder folder;
  const auto fault_of = [&](const std::string& text) {
    const Path file = folder.file("a.json", text);
    const TakeElement take = [](const std::string&, std::size_t, const Json&) {};
    return message_of<ConfigError>([&] { (void)read_json_elements(file, take); });
  };
  const std::string name = (folder / "a.json").string();
  CHECK(fault_of(std::string(300'000, '[')) ==
        name + ": lists and objects are nested more than 64 deep; expected fewer");
  CHECK(fault_of("[1e999]") == name + ": not JSON: number overflow parsing '1e999'");
  CHECK_THAT(fault_of("[1,\n 2"), StartsWith(name + ":2:3: not JSON: "));
  CHECK(fault_of(R"([{"a": 1, "a": 2}])") == name + ": key \"a\" appears twice in one object; expected once");
}

TEST_CASE("A JSON file's errors name it") {
  const TestFolder folder;
  const Path broken = folder.file("broken.json", "[1, 2");
  CHECK_THAT(message_of<ConfigError>([&] { (void)read_json(broken); }),
             StartsWith(broken.string() + ":1:6: not JSON: "));
  CHECK_THROWS_AS(read_json(folder / "missing.json"), IoError);
}

TEST_CASE("Elements of long arrays are passed on one by one and not kept") {
  std::vector<std::string> taken;
  const TakeElement take = [&taken](const std::string& array, std::size_t place, const Json& element) {
    taken.push_back(array + std::to_string(place) + element.dump());
  };
  const std::string text =
      R"({"info": {"n": [1, 2]}, "a": [{"b": [1, {"c": 2}]}, 5, [6]], "z": [], "d": ["x"]})";
  CHECK(parse_json_elements(text, "", take).dump() == R"({"info":{"n":[1,2]},"a":[],"z":[],"d":[]})");
  CHECK(taken == std::vector<std::string>{R"(a0{"b":[1,{"c":2}]})", "a15", "a2[6]", R"(d0"x")"});
  taken.clear();
  CHECK(parse_json_elements(R"([{"a": [1, 2]}, [[3]]])", "", take).dump() == "[]");
  CHECK(taken == std::vector<std::string>{R"(0{"a":[1,2]})", "1[[3]]"});
}

TEST_CASE("Faults of a document read element by element are reported as usual") {
  const TakeElement drop = [](const std::string&, std::size_t, const Json&) {};
  CHECK_THAT(
      message_of<ConfigError>([&] { (void)parse_json_elements("{\"a\": [1,\n NaN]}", "x.json", drop); }),
      StartsWith("x.json:2:2: not JSON: "));
  CHECK(message_of<ConfigError>([&] {
          (void)parse_json_elements(R"([{"k": 1, "k": 2}])", "x.json", drop);
        }) == "x.json: key \"k\" appears twice in one object; expected once");
}

TEST_CASE("Equal documents have no differences") {
  const Json json = parse_json(R"({"a": [1, {"b": 2}], "c": "d"})", "");
  CHECK(differences(json, json).empty());
  // The order of keys does not matter.
  CHECK(differences(json, parse_json(R"({"c": "d", "a": [1, {"b": 2}]})", "")).empty());
}

TEST_CASE("Every difference is reported with its place and both values") {
  const Json here =
      parse_json(R"({"sensor": {"blur_sigma_px": 1, "preset": "a"}, "n": 1, "l": [1, 2, 3]})", "");
  const Json there =
      parse_json(R"({"sensor": {"blur_sigma_px": 2, "preset": "a"}, "m": 1, "l": [1, 5, 3]})", "");
  CHECK(differences(here, there) == std::vector<std::string>{"sensor.blur_sigma_px is 1 here and 2 there",
                                                             "n is only here", "l[1] is 2 here and 5 there",
                                                             "m is only there"});
}

TEST_CASE("Lists of different lengths, and values of different kinds, differ as a whole") {
  CHECK(differences({{"clips", {1, 2}}}, {{"clips", {1}}}) ==
        std::vector<std::string>{"clips has 2 entries here and 1 there"});
  CHECK(differences({{"a", "1"}}, {{"a", 1}}) == std::vector<std::string>{"a is \"1\" here and 1 there"});
}

}  // namespace json_file_test
