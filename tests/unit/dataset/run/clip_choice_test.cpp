#include "base/error.h"
#include "dataset/run/options.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace choose_clips_test {

using namespace thermal;

namespace {

DatasetSpec five_clips() {
  DatasetSpec spec;
  for (const char* id : {"a", "b", "c", "d", "e"}) spec.clips.push_back({.id = id});
  return spec;
}

std::string chosen(const std::vector<std::string>& ids, const Shard& shard) {
  std::string names;
  for (const ClipSpec& clip : choose_clips(five_clips(), ids, shard)) names += clip.id;
  return names;
}

}  // namespace

TEST_CASE("Without a choice all clips are made, in the config's order") {
  CHECK(chosen({}, {}) == "abcde");
  CHECK(chosen({"d", "a"}, {}) == "ad");
}

TEST_CASE("Shards alternate, and together they make every clip once") {
  CHECK(chosen({}, {0, 2}) == "ace");
  CHECK(chosen({}, {1, 2}) == "bd");
  CHECK(chosen({}, {6, 7}).empty());
}

TEST_CASE("A clip belongs to one shard whatever else is requested") {
  CHECK(chosen({"b", "c"}, {0, 2}) == "c");
  CHECK(chosen({"b", "c"}, {1, 2}) == "b");
}

TEST_CASE("An unknown clip is an error") {
  CHECK(message_of<ConfigError>([] { (void)chosen({"f"}, {}); }) ==
        "--clips = \"f\"; expected one of a, b, c, d, e");
}

}  // namespace choose_clips_test
