#include "dataset/exports/webdataset.h"

#include "base/error.h"
#include "io/json/file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "unit/dataset/exports/export_input.h"

namespace webdataset_test {

using namespace thermal;
using Images = std::vector<std::size_t>;

TEST_CASE("WebDataset: shards in the order of pictures, each split with its own") {
  const ExportPlan plan = plan_webdataset(two_splits(), 2);
  REQUIRE(plan.shards.size() == 3);
  CHECK(plan.shards[0].to == "train/night-000000.tar");
  CHECK(plan.shards[0].images == Images{0, 1});
  CHECK(plan.shards[1].to == "train/night-000001.tar");
  CHECK(plan.shards[1].images == Images{2});
  CHECK(plan.shards[2].to == "val/night-000000.tar");
  CHECK(plan.shards[2].images == Images{3});
  CHECK(plan.pictures.empty());
  CHECK(plan.texts.empty());
}

TEST_CASE("WebDataset: a sample says what the set knows, and no more") {
  LabelSet set = two_videos().set;
  set.images[1].time_s = 0.25;
  set.labels[2].visibility = 0.5;
  const std::vector<std::size_t> first = first_labels(set);
  CHECK(parse_json(sample_json(set, 1, first), "sample") == Json({{"clip", "east"},
                                                                  {"frame_index", 2},
                                                                  {"width", 20},
                                                                  {"height", 10},
                                                                  {"time_s", 0.25},
                                                                  {"frame_rate_hz", 12.5},
                                                                  {"annotations",
                                                                   {{{"id", 3},
                                                                     {"category", "human"},
                                                                     {"category_id", 1},
                                                                     {"bbox", {2.5, 1.0, 1.25, 3.0}},
                                                                     {"area", 0.0},
                                                                     {"iscrowd", 0},
                                                                     {"ignore", false},
                                                                     {"noisy", false},
                                                                     {"truncated", false},
                                                                     {"size_class", "medium"},
                                                                     {"track_id", 7},
                                                                     {"visibility", 0.5}}}}}));
  const Json empty = parse_json(sample_json(set, 2, first), "sample");
  CHECK(empty.at("annotations") == Json::array());
  CHECK_FALSE(empty.contains("time_s"));
  CHECK_FALSE(parse_json(sample_json(set, 3, first), "sample").contains("frame_rate_hz"));
}

TEST_CASE("WebDataset: names of shards, and of other files") {
  const ExportInput input = two_splits();
  CHECK(is_shard_name("train/night-000012.tar", input));
  for (const char* other : {"test/night-000012.tar", "night-000012.tar", "train/day-000012.tar",
                            "train/night-000012.zip", "train/more/night-000012.tar"})
    CHECK_FALSE(is_shard_name(other, input));
}

TEST_CASE("WebDataset: a key that is no name of a file is refused") {
  ExportInput input = two_videos();
  input.set.videos[1].name = "-rf";
  CHECK(
      message_of<DataError>([&] { (void)plan_webdataset(input, 9); }) ==
      "\"clips/west/ir8/000000.png\": name of its file = \"-rf_000000.png\"; expected a name of at most 200 "
      "bytes without \"/\" or control characters that does not begin with \"-\"");
}

}  // namespace webdataset_test
