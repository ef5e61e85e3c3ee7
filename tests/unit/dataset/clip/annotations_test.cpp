#include "dataset/clip/annotations.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/test_folder.h"

namespace annotations_test {

using namespace thermal;

namespace {

ManifestObject actor(std::uint16_t index, const std::string& category, int track_id) {
  ManifestObject object;
  object.index = index;
  object.object_class = ObjectClass::actor;
  object.category = category;
  object.track_id = track_id;
  return object;
}

/// Three frames of 10 x 8 px with a person (index 3) and an unknown animal (index 4).
Manifest manifest() {
  Manifest result;
  result.clip = "night_1";
  result.frame_rate_hz = 5;
  result.camera = {.width_px = 10, .height_px = 8, .fx_px = 11.5, .fy_px = 12.5, .cx_px = 5, .cy_px = 4};
  result.objects = {actor(3, "human", 21), actor(4, "antelope", 22)};
  result.frames.resize(3);
  result.frames[1].time_s = 0.2;
  return result;
}

/// An instance whose box has these sides; its pixels are not read.
Instance instance(std::uint16_t index, int width_px, int height_px) {
  return {
      .index = index, .box = {1, 2, width_px, height_px}, .area_px = 5, .truncated = true, .mask = {19, 1}};
}

/// One with all optional properties.
Instance known_instance() {
  Instance known = instance(3, 4, 5);
  known.covered_px = 5.22222222;
  known.visibility = 0.123456;
  known.whole_box = LabelBox{-3.14159, 2, 8.14159, 5.5};
  known.truncated_fraction = 1.0 / 3;
  known.range_m = 61.00004;
  known.temperature_k = 300.12344;
  known.contrast_k = -0.00001;
  known.contrast_noise = -2.5;
  return known;
}

std::string text_of(ClipAnnotations& annotations) {
  std::string text;
  annotations.write([&text](std::string_view piece) { text += piece; });
  return text;
}

Json document_of(ClipAnnotations& annotations) { return Json::parse(text_of(annotations)); }

Json document_of(const std::vector<std::vector<Instance>>& frames) {
  const Manifest used = manifest();
  ClipAnnotations annotations(used, {.k1 = -0.5, .k2 = 0.25, .p1 = 0.125, .k3 = 2});
  for (std::size_t i = 0; i < frames.size(); ++i) annotations.add_frame(static_cast<int>(i), frames[i]);
  return document_of(annotations);
}

std::string size_class_of(const std::vector<std::pair<int, int>>& boxes) {
  const Manifest used = manifest();
  ClipAnnotations annotations(used);
  for (const auto& [width_px, height_px] : boxes)
    annotations.add_frame(0, {instance(3, width_px, height_px)});
  return document_of(annotations)["annotations"][0]["size_class"];
}

}  // namespace

TEST_CASE("An annotation has the fields of COCO and of video datasets") {
  const Json document = document_of({{instance(3, 4, 5)}});
  CHECK(document["annotations"][0].dump() ==
        R"({"id":1,"image_id":1,"category_id":1,"bbox":[1.0,2.0,4.0,5.0],"area":5,)"
        R"("segmentation":{"size":[8,10],"counts":"c01"},"iscrowd":0,"track_id":21,"truncated":true,)"
        R"("noisy":false,"ignore":false,"size_class":"small"})");
  CHECK(
      document["images"][0].dump() ==
      R"({"id":1,"file_name":"ir8/000000.png","width":10,"height":8,"video_id":1,"frame_index":0,"time_s":0.0,"ffc":false})");
  CHECK(
      document["videos"][0].dump() ==
      R"({"id":1,"name":"night_1","width":10,"height":8,"frame_rate_hz":5.0,"frames":1,)"
      R"("camera":{"fx_px":11.5,"fy_px":12.5,"cx_px":5.0,"cy_px":4.0,"k1":-0.5,"k2":0.25,"p1":0.125,"p2":0.0,"k3":2.0}})");
}

TEST_CASE("Optional properties of a target follow, rounded") {
  CHECK(document_of({{known_instance()}})["annotations"][0].dump() ==
        R"({"id":1,"image_id":1,"category_id":1,"bbox":[1.0,2.0,4.0,5.0],"area":5,)"
        R"("segmentation":{"size":[8,10],"counts":"c01"},"iscrowd":0,"track_id":21,)"
        R"("amodal_bbox":[-3.14,2.0,8.14,5.5],"visibility":0.1235,"occluded":true,"truncated":true,)"
        R"("truncated_fraction":0.3333,"covered_px":5.2222,"range_m":61.0,"temperature_k":300.1234,)"
        R"("contrast_k":0.0,"contrast_noise":-2.5,"noisy":false,"ignore":false,"size_class":"small"})");
}

TEST_CASE("The config decides what counts as occluded and what is ignored") {
  const auto flags = [](const LabelParameters& parameters) {
    const Manifest used = manifest();
    ClipAnnotations annotations(used, {}, parameters);
    annotations.add_frame(0, {known_instance()});
    const Json label = document_of(annotations)["annotations"][0];
    return std::pair<bool, bool>{label["occluded"], label["ignore"]};
  };
  CHECK(flags({}) == std::pair(true, false));
  CHECK(flags({.occluded_below_visibility = 0.1}) == std::pair(false, false));
  CHECK(flags({.ignore_below_visibility = 0.5}) == std::pair(true, true));
  CHECK(flags({.ignore_below_area_px = 5}) == std::pair(true, false));
  CHECK(flags({.ignore_below_area_px = 5.5}) == std::pair(true, true));
  CHECK_THROWS_AS(flags({.ignore_below_visibility = 2}), ConfigError);
}

TEST_CASE("A track keeps its id when it is hidden and when it returns") {
  const Json document = document_of({{instance(3, 4, 5), instance(4, 1, 1)}, {}, {instance(3, 4, 5)}});
  REQUIRE(document["annotations"].size() == 3);
  CHECK(document["annotations"][0]["track_id"] == 21);
  CHECK(document["annotations"][2]["track_id"] == 21);
  CHECK(document["annotations"][2]["image_id"] == 3);
}

TEST_CASE("Ids of images and annotations run from 1; a frame without actors is an image too") {
  const Json document = document_of({{}, {instance(3, 1, 1), instance(4, 1, 1)}});
  REQUIRE(document["images"].size() == 2);
  REQUIRE(document["annotations"].size() == 2);
  CHECK(document["images"][1]["id"] == 2);
  CHECK(document["images"][1]["frame_index"] == 1);
  CHECK(document["images"][1]["time_s"] == 0.2);
  CHECK(document["annotations"][0]["id"] == 1);
  CHECK(document["annotations"][1]["id"] == 2);
  CHECK(document["annotations"][1]["image_id"] == 2);
}

TEST_CASE("Categories are those of the clip's actors, by id") {
  CHECK(document_of({{}})["categories"].dump() == R"([{"id":1,"name":"human"},{"id":19,"name":"antelope"}])");
}

// Bondi et al., COMPASS 2018: small below 200 px, large above 2000 px, by the mean over the video.
TEST_CASE("A track's size class depends on its mean box area") {
  CHECK(size_class_of({{199, 1}}) == "small");
  CHECK(size_class_of({{20, 10}}) == "medium");
  CHECK(size_class_of({{50, 40}}) == "medium");
  CHECK(size_class_of({{2001, 1}}) == "large");
  CHECK(size_class_of({{10, 10}, {30, 10}}) == "medium");  // 100 and 300
}

TEST_CASE("The document is laid out like all others") {
  const Manifest used = manifest();
  ClipAnnotations annotations(used);
  annotations.add_frame(0, {instance(3, 4, 5), known_instance()});
  annotations.add_frame(1, {});
  annotations.add_frame(2, {instance(4, 60, 50)});
  const std::string text = text_of(annotations);
  CHECK(text == to_text(Json::parse(text)));
  ClipAnnotations empty(used);
  CHECK(text_of(empty) == to_text(Json::parse(text_of(empty))));
}

TEST_CASE("Labels in a spool file are the same as in memory, and the file is removed") {
  const TestFolder folder;
  const Manifest used = manifest();
  ClipAnnotations in_file(used, {}, {}, folder / "spool");
  ClipAnnotations in_memory(used);
  for (ClipAnnotations* annotations : {&in_file, &in_memory}) {
    annotations->add_frame(0, {known_instance(), instance(4, 1, 1)});
    annotations->add_frame(2, {instance(3, 30, 20)});
  }
  CHECK(in_file.count() == 3);
  CHECK(text_of(in_file) == text_of(in_memory));
  CHECK(std::filesystem::is_empty(folder.path()));
}

}  // namespace annotations_test
