#include "io/label_files/coco.h"

#include "base/error.h"
#include "io/json/file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace coco_file_test {

using namespace thermal;

namespace {

/// Two pictures of a video, not in its order, and three labels, not in the pictures' order.
const char* const kTwoFrames = R"({
  "annotations": [
    {"id": 5, "image_id": 21, "category_id": 2, "bbox": [1, 2, 3.5, 4], "area": 9, "iscrowd": 0, "track_id": 8,
     "visibility": 0.25, "occluded": true, "truncated": true, "truncated_fraction": 0.5, "range_m": 61.5,
     "temperature_k": 291, "contrast_k": -2.5, "contrast_noise": -5, "noisy": true, "ignore": true},
    {"id": 4, "image_id": 20, "category_id": 7, "bbox": [0, 0, 2, 2], "iscrowd": 1},
    {"id": 6, "image_id": 21, "category_id": 7, "bbox": [6, 0, 2, 2], "visibility": null}],
  "categories": [{"id": 7, "name": "human"}, {"id": 2, "name": "lion"}],
  "videos": [{"id": 3, "name": "night", "frame_rate_hz": 9}],
  "images": [
    {"id": 20, "file_name": "clips/night/1.png", "width": 8, "height": 6, "video_id": 3, "frame_index": 1},
    {"id": 21, "file_name": "clips/night/0.png", "width": 8, "height": 6, "video_id": 3, "frame_index": 0}]})";

/// The document with one value changed, `pointer` a JSON pointer.
std::string fault_with(const std::string& pointer, const Json& value) {
  const TemporaryFolder folder;
  Json document = parse_json(kTwoFrames, "");
  document[Json::json_pointer(pointer)] = value;
  const Path file = folder.file("truth.json", document.dump());
  const std::string message = message_of<DataError>([&] { (void)read_coco(file); });
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

std::string fault_in(const std::string& text) {
  const TemporaryFolder folder;
  const Path file = folder.file("truth.json", text);
  const std::string message = message_of<DataError>([&] { (void)read_coco(file); });
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

}  // namespace

TEST_CASE("A COCO file becomes labels in the order of videos and frames") {
  const TemporaryFolder folder;
  const LabelSet set = read_coco(folder.file("truth.json", kTwoFrames));
  CHECK(set.name == "truth");
  CHECK(set.root == folder.path().string());
  REQUIRE(set.images.size() == 2);
  CHECK(set.images[0].id == 21);
  CHECK(set.images[0].file == "clips/night/0.png");
  CHECK(set.images[1].frame_index == 1);
  CHECK(set.videos[0].frame_rate_hz == 9);
  REQUIRE(set.labels.size() == 3);
  CHECK(set.labels[0].id == 5);
  CHECK(set.labels[1].id == 6);
  CHECK(set.labels[2].id == 4);
  CHECK(set.labels[2].image == 1);
  CHECK(set.categories[set.labels[0].category].name == "lion");
}

TEST_CASE("A label's optional properties are read if present") {
  const TemporaryFolder folder;
  const LabelSet set = read_coco(folder.file("truth.json", kTwoFrames));
  const Label& reported = set.labels[0];
  CHECK(reported.box == LabelBox{1, 2, 3.5, 4});
  CHECK(reported.area_px == 9);
  CHECK((reported.ignore && reported.noisy && reported.truncated && !reported.crowd));
  CHECK(reported.occluded == std::optional(true));
  CHECK(reported.track_id == std::optional<std::int64_t>(8));
  CHECK(reported.visibility == std::optional(0.25));
  CHECK(reported.truncated_fraction == std::optional(0.5));
  CHECK(reported.range_m == std::optional(61.5));
  CHECK(reported.temperature_k == std::optional(291.0));
  CHECK(reported.contrast_k == std::optional(-2.5));
  CHECK(reported.contrast_noise == std::optional(-5.0));
  const Label& plain = set.labels[2];
  CHECK(plain.area_px == 4);  // of the box
  CHECK((plain.crowd && !plain.ignore && !plain.noisy && !plain.truncated));
  CHECK((!plain.occluded && !plain.track_id && !plain.visibility && !plain.range_m && !plain.contrast_k));
  CHECK_FALSE(set.labels[1].visibility);  // null
}

TEST_CASE("Pictures without a video form a video per folder") {
  const TemporaryFolder folder;
  const LabelSet set = read_coco(folder.file("val.json", R"({"categories": [], "annotations": [], "images": [
      {"id": 1, "file_name": "b/x/0.jpg"}, {"id": 2, "file_name": "1.jpg"}, {"id": 3, "file_name": "b/x/1.jpg"}]})"));
  REQUIRE(set.videos.size() == 2);
  CHECK(set.videos[0].name == "b_x");
  CHECK(set.videos[1].name == "val");
  CHECK(set.images[1].id == 3);
  CHECK(set.images[1].width_px == 0);
  CHECK(flat_name(set, set.images[1]) == "b_x_1");
  CHECK(flat_name(set, set.images[2]) == "val_1");
}

TEST_CASE("Faults of a COCO file are reported with the entry") {
  CHECK(fault_with("/images/1/id", 20) == "images[1].id = 20; expected an id other than that of entry 0");
  CHECK(fault_with("/categories/1/id", 7) ==
        "categories[1].id = 7; expected an id other than that of entry 0");
  CHECK(fault_with("/annotations/2/id", 5) ==
        "annotations[2].id = 5; expected an id other than that of entry 0");
  CHECK(fault_with("/annotations/1/image_id", 9) ==
        "annotations[1].image_id = 9; expected the id of one of the images");
  CHECK(fault_with("/annotations/1/category_id", 1) ==
        "annotations[1].category_id = 1; expected the id of one of the categories");
  CHECK(fault_with("/images/0/video_id", 1) ==
        "images[0].video_id = 1; expected the id of one of the videos");
  CHECK(fault_with("/images/0/width", -8) ==
        "images[0].width = -8; expected a whole number from 0 to 1000000000");
  CHECK(fault_with("/images/0/file_name", "") == "images[0].file_name = \"\"; expected a string");
  CHECK(fault_with("/images/0", 5) == "images[0] = 5; expected an object");
  CHECK(fault_with("/annotations/0/area", "big") ==
        "annotations[0].area = \"big\"; expected a finite number");
  CHECK(fault_with("/annotations/0/ignore", 2) == "annotations[0].ignore = 2; expected 0, 1, false or true");
  CHECK(fault_with("/annotations/0/id", 9223372036854775808U) ==
        "annotations[0].id = 9223372036854775808; expected a whole number up to 9223372036854775807");
  CHECK(fault_with("/annotations/0/id", 1.5) == "annotations[0].id = 1.5; expected a whole number");
}

TEST_CASE("A box is four numbers and in its picture") {
  const std::string rule = "; expected x, y, width and height in px, the last two not negative";
  CHECK(fault_with("/annotations/1/bbox", {1, 2, 3}) == "annotations[1].bbox = [1,2,3]" + rule);
  CHECK(fault_with("/annotations/1/bbox", {1, 2, -3, 4}) == "annotations[1].bbox = [1,2,-3,4]" + rule);
  CHECK(fault_with("/annotations/1/bbox", {1, 2, nullptr, 4}) == "annotations[1].bbox = [1,2,null,4]" + rule);
  CHECK(fault_with("/annotations/1/bbox", {1, 2, 1e308, 4}) ==
        "annotations[1].bbox = [1,2,1e+308,4]; expected numbers of at most 1e9 px");
  CHECK(fault_with("/annotations/0/bbox", {8, 0, 2, 2}) ==
        "annotations[0].bbox = [8, 0, 2, 2] px; expected a box inside its picture, 8 x 6 px");
  CHECK(fault_with("/annotations/0/bbox", {-3, 0, 2, 2}) ==
        "annotations[0].bbox = [-3, 0, 2, 2] px; expected a box inside its picture, 8 x 6 px");
  CHECK(fault_with("/annotations/0/bbox", {-1, -1, 20, 20}) == "(no fault was thrown)");  // extends beyond it
}

TEST_CASE("Other files than COCO are reported") {
  CHECK(fault_in("[]") ==
        ": no list \"images\"; expected a COCO file with images, categories and annotations");
  CHECK(fault_in(R"({"images": [], "categories": []})") ==
        ": no list \"annotations\"; expected a COCO file with images, categories and annotations");
  CHECK(fault_in(R"({"images": [], "categories": [], "annotations": [{}]})") ==
        ": annotations[0].bbox = nothing; expected one");
  CHECK_THAT(fault_in("{\"images\": [,]}"), StartsWith(":1:13: not JSON: "));
  CHECK_THROWS_AS(read_coco("/nowhere/truth.json"), IoError);
}

}  // namespace coco_file_test
