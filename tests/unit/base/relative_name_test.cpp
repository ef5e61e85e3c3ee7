#include "base/relative_name.h"

#include "support/catch.h"

namespace relative_name_test {

using thermal::RelativeName;

TEST_CASE("Names that stay below a folder are taken as they are") {
  for (const std::string name : {"a", "ir8/000000.png", "a b/c.d", "...", "..a", "a-", "café", ".hidden"}) {
    CAPTURE(name);
    REQUIRE(RelativeName::of(name));
    CHECK(RelativeName::of(name)->text() == name);
  }
}

TEST_CASE("Names that lead elsewhere, or that a terminal or a program would misread, are refused") {
  for (const std::string name :
       {"",     "/",     "/etc/passwd", "..",       "../a", "a/..",          "a/../../b", ".",
        "./a",  "a//b",  "a/",          "-rf",      "a/-b", "a\nb",          "\x1b[2J",   "a\tb",
        "\xff", "a\x7f", "..\\a",       "a\\..\\b", "\\a",  "\\\\server\\a", "a\\-b",     "C:\\a",
        "c:/a", "C:a"}) {
    CAPTURE(name);
    CHECK_FALSE(RelativeName::of(name));
  }
  CHECK_FALSE(RelativeName::of(std::string_view("a\0b", 3)));
}

TEST_CASE("Lengths are limited") {
  CHECK(RelativeName::of(std::string(200, 'a')));
  CHECK_FALSE(RelativeName::of(std::string(201, 'a')));
  std::string deep = "a";
  while (deep.size() < RelativeName::kMostBytes - 1) deep += "/a";
  CHECK(RelativeName::of(deep));
  CHECK_FALSE(RelativeName::of(deep + "/a"));
}

TEST_CASE("A part is a name without a folder") {
  CHECK(RelativeName::part_of("clip_1"));
  CHECK_FALSE(RelativeName::part_of("clips/clip_1"));
  CHECK_FALSE(RelativeName::part_of(".."));
}

}  // namespace relative_name_test
