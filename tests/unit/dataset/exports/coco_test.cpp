#include "dataset/exports/coco.h"

#include "base/error.h"
#include "dataset/exports/source.h"
#include "io/json/file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "unit/dataset/exports/export_input.h"

namespace coco_test {

using namespace thermal;

namespace {

/// A possible source file of two_videos(), with unknown keys and an unused category.
const std::string kText =
    R"({"info":{"year":2026},"licenses":[{"id":1,"name":"CC0"}],)"
    R"("annotations":[{"id":4,"image_id":14,"category_id":10,"bbox":[10,2,4.0,4],"mine":[1,{"a":0.1}]},)"
    R"({"id":1,"image_id":11,"category_id":1,"segmentation":{"size":[10,20],"counts":"c01"}},)"
    R"({"id":3,"image_id":12,"category_id":1},{"id":2,"image_id":11,"category_id":8}],)"
    R"("videos":[{"id":1,"name":"east"},{"id":"w","name":"west"}],)"
    R"("images":[{"id":14,"file_name":"clips/west/ir8/000000.png","video_id":"w"},)"
    R"({"id":11,"video_id":1,"file_name":"clips/east/ir8/000000.png","time_s":0.0},)"
    R"({"id":12,"video_id":1,"file_name":"x.png"},{"id":13,"video_id":1,"file_name":"x.png"}],)"
    R"("categories":[{"id":1,"name":"human"},{"id":8,"name":"giraffe"},{"id":10,"name":"vehicle"},)"
    R"({"id":11,"name":"none"}],"last":null})";

Json json_of(const ExportPlan& plan, const std::string& to) { return parse_json(text_of(plan, to), to); }

}  // namespace

TEST_CASE("A COCO file exported as it is keeps every byte, and pictures stay in their folders") {
  const ExportPlan plan = plan_coco(two_videos(), "  {} ", "a.json", true);
  CHECK(text_of(plan, "annotations.json") == "  {} ");
  CHECK(targets_of(plan)[1] == "clips/east/ir8/000002.png");
  CHECK(plan.texts.size() == 1);
}

TEST_CASE("A COCO file for each split has its pictures, labels and videos, and everything else unchanged") {
  const ExportPlan plan = plan_coco(two_splits(), kText, "a.json", false);
  CHECK(plan.texts.size() == 2);
  CHECK(text_of(plan, "annotations/val.json") ==
        R"({"info":{"year":2026},"licenses":[{"id":1,"name":"CC0"}],)"
        R"("annotations":[{"id":4,"image_id":14,"category_id":10,"bbox":[10,2,4.0,4],"mine":[1,{"a":0.1}]}],)"
        R"("videos":[{"id":"w","name":"west"}],)"
        R"("images":[{"id":14,"file_name":"clips/west/ir8/000000.png","video_id":"w"}],)"
        R"("categories":[{"id":1,"name":"human"},{"id":8,"name":"giraffe"},{"id":10,"name":"vehicle"},)"
        R"({"id":11,"name":"none"}],"last":null})"
        "\n");
  const Json train = json_of(plan, "annotations/train.json");
  CHECK(train["annotations"].size() == 3);
  CHECK(train["annotations"][0]["segmentation"]["counts"] == "c01");
  CHECK(train["images"].size() == 3);
  CHECK(train["images"][1]["file_name"] == "clips/east/ir8/000002.png");  // as in the set
  CHECK(train["videos"].dump() == R"([{"id":1,"name":"east"}])");
}

TEST_CASE("Ids of any kind refer to each other, and an annotation without a box stays as it is") {
  ExportInput input = two_splits();
  input.set.images[3].id = "w/0";
  input.set.labels[3].id = "d";
  input.boxes_changed = true;
  const std::string text =
      R"({"annotations":[{"id":"d","image_id":"w/0","category_id":10,"bbox":[0,0,1,1]},)"
      R"({"id":"e","image_id":"w/0","category_id":0}],"videos":[{"id":2.0,"name":"west"}],)"
      R"("images":[{"id":"w/0","file_name":"a\\b.png","video_id":2}]})";
  const Json document = json_of(plan_coco(input, text, "a.json", false), "annotations/val.json");
  CHECK(document["annotations"].dump() ==
        R"([{"id":"d","image_id":"w/0","category_id":10,"bbox":[10.0,2.0,4.0,4.0]},)"
        R"({"id":"e","image_id":"w/0","category_id":0}])");
  CHECK(document["images"][0]["file_name"] == "clips/west/ir8/000000.png");
  CHECK(document["videos"].size() == 1);
}

TEST_CASE("Labels of another source become a COCO file") {
  ExportInput input = two_videos();
  input.set.labels[0].occluded = true;
  const Json document = parse_json(coco_text(input.set), "text");
  CHECK(
      document["annotations"][0].dump() ==
      R"({"id":1,"image_id":11,"category_id":1,"bbox":[0.0,0.0,5.0,2.0],"area":0.0,"iscrowd":0,"track_id":7,)"
      R"("occluded":true,"noisy":false,"ignore":false,"size_class":"medium"})");
  CHECK(
      document["images"][3].dump() ==
      R"({"id":14,"file_name":"clips/west/ir8/000000.png","width":20,"height":10,"video_id":2,"frame_index":0})");
  CHECK(document["categories"].size() == 3);
  CHECK(document["videos"][1].dump() == R"({"id":2,"name":"west"})");
}

// --- selections ------------------------------------------------------------------------------------------------------

namespace {

SelectedDataset taking(const std::vector<SelectedVideo>& videos) {
  return {.path = "night", .name = "night", .videos = videos};
}

}  // namespace

TEST_CASE("A selection exports its frames with their labels") {
  const ExportInput input = two_videos();
  const LabelSet taken = take_selected(
      input.set, taking({{.name = "east", .frames = {2, 3}}, {.name = "west", .frames = {0}}}), "s.json");
  REQUIRE(taken.images.size() == 3);
  CHECK(taken.images[0].id == LabelId(12));
  CHECK(taken.videos.size() == 2);
  REQUIRE(taken.labels.size() == 2);
  CHECK(taken.labels[0].id == LabelId(3));
  CHECK(taken.labels[0].image == 0);
  CHECK(taken.labels[1].image == 2);
}

TEST_CASE("A COCO file of selected frames has no others") {
  ExportInput input = two_videos();
  input.set = take_selected(input.set, taking({{.name = "east", .frames = {0}}}), "s.json");
  const Json document = json_of(plan_coco(input, kText, "a.json", false), "annotations.json");
  CHECK(document["images"].size() == 1);
  CHECK(document["annotations"].size() == 2);
  CHECK(document["annotations"][1]["id"] == 2);
  CHECK(document["videos"].size() == 1);
  CHECK(document["categories"].size() == 4);
}

TEST_CASE("Selections of unknown videos and frames are errors") {
  const LabelSet set = two_videos().set;
  const auto fault_of = [&set](const std::vector<SelectedVideo>& videos) {
    return message_of<DataError>([&] { (void)take_selected(set, taking(videos), "s.json"); });
  };
  CHECK(fault_of({{.name = "eest", .frames = {0}}}) ==
        "s.json: video \"eest\" is not in night; expected one of east, west; did you mean \"east\"?");
  CHECK(fault_of({{.name = "east", .frames = {0, 1}}}) ==
        "s.json: video \"east\" of night has no frame 1; expected a frame_index of its pictures");
  CHECK(fault_of({{.name = "east", .frames = {}}}) == "s.json: no frame of night; expected at least one");
}

}  // namespace coco_test
