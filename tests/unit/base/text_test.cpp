#include "base/text.h"

#include <vector>

#include "support/catch.h"

namespace text_test {

using namespace thermal;

namespace {

const std::vector<std::string> kSpecies = {"elephant", "human", "lion", "rhinoceros", "zebra"};

}  // namespace

TEST_CASE("A near miss is one or two edits away") {
  CHECK(near_miss("zebr", kSpecies) == "zebra");             // a letter left out
  CHECK(near_miss("zeebra", kSpecies) == "zebra");           // one too many
  CHECK(near_miss("zepra", kSpecies) == "zebra");            // a wrong one
  CHECK(near_miss("zerba", kSpecies) == "zebra");            // neighbours swapped
  CHECK(near_miss("elefant", kSpecies) == "elephant");       // two edits
  CHECK(near_miss("rihnocreos", kSpecies) == "rhinoceros");  // two swaps
}

TEST_CASE("A swap of neighbours counts as one edit, not two") {
  // "ingot_ms" is two replacements away; if a swap were two edits, it would win as the first of equals.
  CHECK(near_miss("ingot_km", std::vector<std::string>{"ingot_ms", "ingto_km"}) == "ingto_km");
}

TEST_CASE("A distant word is not a near miss") {
  CHECK(near_miss("giraffe", kSpecies).empty());
  CHECK(near_miss("", kSpecies).empty());
  CHECK(near_miss("zebra", std::vector<std::string>{}).empty());
}

TEST_CASE("A short word must keep more than half its letters") {
  CHECK(near_miss("loon", kSpecies) == "lion");  // one of four
  CHECK(near_miss("loan", kSpecies).empty());    // two of four
}

TEST_CASE("The nearest wins, and among equals the first") {
  CHECK(near_miss("shrubb", std::vector<std::string>{"scrub", "shrub"}) == "shrub");
  CHECK(near_miss("path_x", std::vector<std::string>{"path_a", "path_b"}) == "path_a");
}

TEST_CASE("A suggestion is ready to be appended to a message") {
  CHECK(did_you_mean("humam", kSpecies) == "; did you mean \"human\"?");
  CHECK(did_you_mean("giraffe", kSpecies).empty());
}

TEST_CASE("A list of names is cut when it gets long") {
  CHECK(list_names(std::vector<std::string>{}).empty());
  CHECK(list_names(kSpecies) == "elephant, human, lion, rhinoceros, zebra");
  CHECK(list_names(kSpecies, 5) == "elephant, human, lion, rhinoceros, zebra");
  CHECK(list_names(kSpecies, 2) == "elephant, human, … (5 in all)");
}

TEST_CASE("A text is split at every separator") {
  using Parts = std::vector<std::string_view>;
  CHECK(split("a,,b", ',') == Parts{"a", "", "b"});
  CHECK(split("a\n", '\n') == Parts{"a", ""});
  CHECK(split("", ',') == Parts{""});
}

TEST_CASE("A number is the whole of its text") {
  CHECK(number_in<int>("-12") == std::optional(-12));
  CHECK(number_in<double>("2.5e-1") == std::optional(0.25));
  for (const char* text : {"", " 1", "1 ", "+1", "1x", "99999999999"}) CHECK_FALSE(number_in<int>(text));
  CHECK_FALSE(number_in<std::size_t>("-1"));
}

TEST_CASE("Names are in the order of their numbers") {
  const auto sign = [](const char* one, const char* other) {
    CHECK(compare_names(other, one).sign == -compare_names(one, other).sign);
    return compare_names(one, other).sign;
  };
  CHECK(sign("frame 2.png", "frame 10.png") == -1);
  CHECK(sign("frame 002.png", "frame 10.png") == -1);
  CHECK(sign("a/10", "b/2") == -1);
  CHECK(sign("clip", "clip 1") == -1);
  CHECK(sign("x1", "xa") == -1);
  CHECK(sign("x1.png", "x01.png") == 0);
  CHECK(sign("18446744073709551617", "18446744073709551616") == 1);
  CHECK(sign("", "") == 0);
}

TEST_CASE("It is said whether numbers decide") {
  CHECK(compare_names("frame_0001_ab3.png", "frame_0002_9cd.png").by_number);
  CHECK_FALSE(compare_names("a1", "b1").by_number);
  CHECK_FALSE(compare_names("9cd", "ab3").by_number);
  CHECK_FALSE(compare_names("1.jpg", "1.png").by_number);
}

}  // namespace text_test
