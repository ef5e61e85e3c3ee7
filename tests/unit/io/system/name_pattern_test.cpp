#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "io/system/sequence.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace name_pattern_test {

using thermal::ConfigError;
using thermal::NamePattern;
using thermal::NumberPosition;

namespace {

/// The digits a pattern finds in a name, "" where it has no number, "none" where the name does not match.
std::string number_in(const std::string& pattern, const std::string& name) {
  const auto place = NamePattern(pattern, "sequence").match(name);
  return place ? name.substr(place->at, place->digits) : "none";
}

std::string fault_of(const std::string& pattern) {
  return message_of<ConfigError>([&pattern] { NamePattern(pattern, "sequence"); });
}

}  // namespace

TEST_CASE("hashes and printf specifiers are the frame's number") {
  for (const char* pattern : {"f_####.exr", "f_%04d.exr", "f_*####.exr", "?_####.*"}) {
    CHECK(number_in(pattern, "f_0012.exr") == "0012");
    CHECK(number_in(pattern, "f_12345.exr") == "12345");
    CHECK(number_in(pattern, "f_0.exr") == "none");
    CHECK(number_in(pattern, "f_12a4.exr") == "none");
  }
  CHECK(number_in("f_####.exr", "f_00012.exr") == "none");  // five digits only if a number has five
  CHECK(number_in("f_%d.exr", "f_7.exr") == "7");
  CHECK(number_in("f_%d.exr", "f_0.exr") == "0");
  CHECK(number_in("f_%d.exr", "f_120.exr") == "120");
  CHECK(number_in("f_%d.exr", "f_07.exr") == "none");
  CHECK(number_in("#_f_9.exr", "12_f_9.exr") == "12");
}

TEST_CASE("if a number can start at several places, the first counts, and it is as long as possible") {
  CHECK(number_in("*#.exr", "f123.exr") == "123");
  CHECK(number_in("*##*", "a10b20") == "10");
  CHECK(number_in("*##*", "a100b20") == "100");
  CHECK(number_in("*##.exr", "f0123.exr") == "123");
}

TEST_CASE("stars and question marks work as in shells") {
  CHECK(number_in("*.exr", "a.exr").empty());
  CHECK(number_in("*", "").empty());
  CHECK(number_in("a*b*c", "axxbxxc").empty());
  CHECK(number_in("a*b*c", "axxbxxcd") == "none");
  CHECK(number_in("?.exr", "ab.exr") == "none");
  CHECK(number_in("plain.exr", "plain.exr").empty());
  CHECK(number_in("plain.exr", "Plain.exr") == "none");
  CHECK(number_in("", "") == "");
  CHECK(number_in("", "a") == "none");
}

TEST_CASE("a pattern with many stars is not slow") {
  std::string stars;
  for (int i = 0; i < 84; ++i) stars += "*a";  // a backtracking matcher would try 10^60 ways
  CHECK(number_in(stars + "b", std::string(255, 'a')) == "none");
}

TEST_CASE("the position of a number is found") {
  CHECK(NamePattern("shot2_##.exr", "").match("shot2_07.exr") == NumberPosition{.at = 6, .digits = 2});
}

TEST_CASE("invalid patterns are errors") {
  CHECK(fault_of("a_##_##.exr") == "sequence = \"a_##_##.exr\"; expected one number, such as #### or %06d");
  CHECK(fault_of("a_%d_%d.exr") == "sequence = \"a_%d_%d.exr\"; expected one number, such as #### or %06d");
  CHECK(fault_of("a_%d_#.exr") == "sequence = \"a_%d_#.exr\"; expected one number, such as #### or %06d");
  for (const char* pattern : {"%", "%6d", "%06", "%0d", "%00", "%s", "%06x", "100%.exr", "%%"})
    CHECK(fault_of(pattern) == fmt::format("sequence = \"{}\"; expected % only as in %d or %06d", pattern));
  for (const std::string& pattern : {std::string("%00d"), std::string("%019d"),
                                     std::string("%099999999999999999999d"), std::string(19, '#')})
    CHECK(fault_of(pattern) == fmt::format("sequence = \"{}\"; expected numbers of 1 to 18 digits", pattern));
  CHECK(fault_of("../*.exr") == "sequence = \"../*.exr\"; expected names in one folder, without /");
  const std::string longest(256, '*');
  CHECK(fault_of(longest) == fmt::format("sequence = \"{}\"; expected at most 255 characters", longest));
}

TEST_CASE("patterns are recognised") {
  for (const char* name : {"*.exr", "a?.exr", "#.exr", "%d"}) CHECK(NamePattern::has_wildcards(name));
  CHECK_FALSE(NamePattern::has_wildcards("f_0001.exr"));
}

}  // namespace name_pattern_test
