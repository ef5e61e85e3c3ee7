#include "io/system/sequence.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace sequence_test {

using namespace thermal;

namespace {

using Names = std::vector<std::string>;

FrameSequence sequence(const Names& names) {
  std::vector<FrameName> frames;
  for (const std::string& name : names) frames.push_back({.name = name, .number = {}});
  return sequence_of(std::move(frames), "r");
}

/// Names in order, those of gaps in brackets.
Names order_of(const FrameSequence& sequence) {
  Names names;
  for (const auto& [frame, is_gap] : sequence.frames)
    names.push_back(is_gap ? fmt::format("[{}]", frame.name) : frame.name);
  return names;
}

Names order_of(const Names& names) { return order_of(sequence(names)); }

std::string fault_of(const Names& names) {
  return message_of<DataError>([&names] { (void)sequence(names); });
}

}  // namespace

TEST_CASE("files are sorted by their numbers") {
  CHECK(order_of(Names{"f_10.exr", "f_9.exr", "f_11.exr"}) == Names{"f_9.exr", "f_10.exr", "f_11.exr"});
  CHECK(order_of(Names{"2.exr", "1.exr", "2.exr"}) == Names{"1.exr", "2.exr"});
  CHECK(order_of(Names{"f_7.exr"}) == Names{"f_7.exr"});
}

TEST_CASE("a missing number is a gap, under the name it would have") {
  CHECK(order_of(Names{"f_0008.exr", "f_0011.exr", "f_0009.exr"}) ==
        Names{"f_0008.exr", "f_0009.exr", "[f_0010.exr]", "f_0011.exr"});
  CHECK(order_of(Names{"f_9.exr", "f_8.exr", "f_11.exr"}) ==
        Names{"f_8.exr", "f_9.exr", "[f_10.exr]", "f_11.exr"});
  CHECK(sequence({"f_1.exr", "f_2.exr", "f_5.exr"}).gaps() == 2);
}

TEST_CASE("frames are spaced by their greatest common step") {
  const FrameSequence found = sequence({"a0010.exr", "a0040.exr", "a0020.exr"});
  CHECK(found.step == 10);
  CHECK(order_of(found) == Names{"a0010.exr", "a0020.exr", "[a0030.exr]", "a0040.exr"});
  CHECK(sequence({"a0001.exr", "a0101.exr"}).step == 100);
  CHECK(sequence({"a0001.exr"}).step == 1);
}

TEST_CASE("the number is the last one that is not the same in all names") {
  CHECK(order_of(Names{"f_0002_v2.exr", "f_0001_v2.exr"}) == Names{"f_0001_v2.exr", "f_0002_v2.exr"});
  CHECK(order_of(Names{"s1_0002.exr", "s1_0001.exr"}) == Names{"s1_0001.exr", "s1_0002.exr"});
  CHECK(order_of(Names{"f2.v1", "f1.v2"}) == Names{"f1.v2", "f2.v1"});  // an extension has no frame number
}

TEST_CASE("a pattern determines the number") {
  const NamePattern pattern("f_##_*.exr", "");
  const FrameSequence found =
      sequence_of(names_matching(pattern, {"f_02_1.exr", "f_01_9.exr", "g_03_1.exr"}), "r");
  CHECK(order_of(found) == Names{"f_01_9.exr", "f_02_1.exr"});
}

TEST_CASE("names without any number are sorted and have no gaps") {
  CHECK(order_of(Names{"b.exr", "a.exr", "c.exr"}) == Names{"a.exr", "b.exr", "c.exr"});
}

TEST_CASE("names that cannot be sorted are errors") {
  CHECK(fault_of({"f_1.exr", "f_01.exr"}) ==
        "r: f_01.exr and f_1.exr both have number 1; expected one file per number, or a pattern that leaves "
        "some out");
  CHECK(fault_of({"left_1.exr", "left_2.exr", "right_1.exr"}) ==
        "r: left_1.exr and right_1.exr both have number 1; expected one file per number, or a pattern that "
        "leaves some "
        "out");
  CHECK(fault_of({"f_1.exr", "thumbnail.exr"}) ==
        "r: thumbnail.exr has no number, and f_1.exr has one; expected one in all names, or a pattern that "
        "leaves some "
        "out");
  CHECK(fault_of({"f_1.exr", "f_9999999999999999999.exr"}) ==
        "r: the number of f_9999999999999999999.exr has 19 digits; expected at most 18");
  CHECK(fault_of({"1.exr", "2.exr", "1000000000.exr"}) ==
        "r: 3 files have numbers from 1 to 1000000000 in steps of 1, so 999999997 are missing; expected at "
        "most 30 "
        "missing, or a manifest that lists the files in frames");
  CHECK(fault_of({"0.exr", "1.exr", "999999999999999999.exr"}) ==
        "r: 3 files have numbers from 0 to 999999999999999999 in steps of 1, so 999999999999999997 are "
        "missing; "
        "expected at most 30 missing, or a manifest that lists the files in frames");
}

TEST_CASE("ten gaps per file are the most") {
  CHECK(order_of(Names{"1.exr", "2.exr", "33.exr"}).size() == 33);
  CHECK(fault_of({"1.exr", "2.exr", "34.exr"}) ==
        "r: 3 files have numbers from 1 to 34 in steps of 1, so 31 are missing; expected at most 30 missing, "
        "or a "
        "manifest that lists the files in frames");
}

TEST_CASE("a pattern for a sequence matches all of it") {
  CHECK(pattern_of(sequence({"f_0001.exr", "f_0003.exr", "f_0004.exr"})) == "f_####.exr");
  CHECK(pattern_of(sequence({"f_9.exr", "f_10.exr"})) == "f_#.exr");
  CHECK(pattern_of(sequence({"f_0001_v2.exr", "f_0002_v2.exr"})) == "f_####_v2.exr");
  CHECK(pattern_of(sequence({"render.exr"})) == "render.exr");
}

TEST_CASE("without a matching pattern the result is empty") {
  CHECK(pattern_of(sequence({"a.exr", "b.exr"})).empty());
  CHECK(pattern_of(sequence({"a1.exr", "b2.exr"})).empty());
  CHECK(pattern_of(sequence({"50%_1.exr", "50%_2.exr"})).empty());
  CHECK(pattern_of(sequence({"f_01.exr", "f_002.exr"})).empty());
}

TEST_CASE("passes of a folder: EXR files, otherwise PNG files, and no hidden ones") {
  const TestFolder folder;
  for (const char* name : {"a1.png", "B2.PNG", ".c3.png", "notes.txt"}) (void)folder.file(name, "");
  std::filesystem::create_directory(folder / "d4.png");
  const Names names = files_in(folder.path());
  CHECK(names == Names{"B2.PNG", "a1.png", "notes.txt"});
  CHECK(passes_among(names).size() == 2);
  CHECK(passes_among({"a1.png", "a1.exr", ".exr"}).front().name == "a1.exr");
  CHECK(passes_among({"a1.png", "a1.exr", "x.EXR", ".exr"}).size() == 2);
  CHECK(message_of<IoError>([&] { (void)files_in(folder / "none"); }) ==
        fmt::format("cannot read {}: No such file or directory", (folder / "none").string()));
}

}  // namespace sequence_test
