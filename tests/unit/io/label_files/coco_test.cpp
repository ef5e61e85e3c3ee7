#include "io/label_files/coco.h"

#include "base/error.h"
#include "io/json/file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

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
  const TestFolder folder;
  Json document = parse_json(kTwoFrames, "");
  document[Json::json_pointer(pointer)] = value;
  const Path file = folder.file("truth.json", document.dump());
  const std::string message = message_of<DataError>([&] { (void)read_coco(file); });
  const std::string name = file.string() + ": ";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

std::string fault_in(const std::string& text) {
  const TestFolder folder;
  const Path file = folder.file("truth.json", text);
  const std::string message = message_of<DataError>([&] { (void)read_coco(file); });
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

}  // namespace

TEST_CASE("A COCO file becomes labels in the order of videos and frames") {
  const TestFolder folder;
  const LabelSet set = read_coco(folder.file("truth.json", kTwoFrames));
  CHECK(set.name == "truth");
  CHECK(set.root == folder.path().string());
  REQUIRE(set.images.size() == 2);
  CHECK(set.images[0].id == LabelId(21));
  CHECK(set.images[0].file == "clips/night/0.png");
  CHECK(set.images[1].frame_index == 1);
  CHECK(set.videos[0].frame_rate_hz == 9);
  REQUIRE(set.labels.size() == 3);
  CHECK(set.labels[0].id == LabelId(5));
  CHECK(set.labels[1].id == LabelId(6));
  CHECK(set.labels[2].id == LabelId(4));
  CHECK(set.labels[2].image == 1);
  CHECK(set.categories[set.labels[0].category].name == "lion");
}

TEST_CASE("A label's optional properties are read if present") {
  const TestFolder folder;
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
  const TestFolder folder;
  const LabelSet set = read_coco(folder.file("val.json", R"({"categories": [], "annotations": [], "images": [
      {"id": 1, "file_name": "b/x/0.jpg"}, {"id": 2, "file_name": "1.jpg"}, {"id": 3, "file_name": "b/x/1.jpg"}]})"));
  REQUIRE(set.videos.size() == 2);
  CHECK(set.videos[0].name == "b_x");
  CHECK(set.videos[1].name == "val");
  CHECK(set.images[1].id == LabelId(3));
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
        ": annotations[0].image_id = nothing; expected one");
  CHECK_THAT(fault_in("{\"images\": [,]}"), StartsWith(":1:13: not JSON: "));
  CHECK_THROWS_AS(read_coco("/nowhere/truth.json"), IoError);
}

// --- the order of time -----------------------------------------------------------------------------------------------

namespace {

/// Labels of a file with these images and annotations, of categories 0 "empty" and 1 "elephant".
LabelSet read_family(const std::string& images, const std::string& annotations = "[]",
                     const std::string& videos = R"([{"id": 1, "name": "vid"}])") {
  const TestFolder folder;
  return read_coco(folder.file(
      "truth.json", R"({"categories": [{"id": 0, "name": "empty"}, {"id": 1, "name": "elephant"}],)"
                    R"("videos": )" +
                        videos + R"(, "images": )" + images + R"(, "annotations": )" + annotations + "}"));
}

std::string family_fault(const std::string& images, const std::string& annotations = "[]") {
  const std::string message = message_of<DataError>([&] { (void)read_family(images, annotations); });
  return message.substr(message.find(": ") == std::string::npos ? 0 : message.find(": ") + 2);
}

std::vector<std::string> files_of(const LabelSet& set) {
  std::vector<std::string> files;
  for (const LabelImage& image : set.images) files.push_back(image.file);
  return files;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("Frames are in the order that CocoVID and COCO Camera Traps state") {
  for (const std::string key : {"frame_index", "frame_id", "frame_num"}) {
    const LabelSet set =
        read_family(R"([{"id": 3, "file_name": "1.png", "video_id": 1, ")" + key +
                    R"(": 20}, {"id": 1, "file_name": "2.png", "video_id": 1.0, ")" + key +
                    R"(": 4.0}, {"id": 2, "file_name": "3.png", "video_id": 1, ")" + key + R"(": 5}])");
    CHECK(files_of(set) == Names{"2.png", "3.png", "1.png"});
    CHECK(set.images[0].frame_index == 4);
    CHECK(set.images[2].frame_index == 20);
    CHECK(set.videos[0].in_time);
  }
}

TEST_CASE("Pictures of a sequence form a video") {
  const LabelSet set =
      read_family(R"([{"id": "b", "file_name": "s/2.png", "seq_id": "night", "frame_num": 1},)"
                  R"({"id": "c", "file_name": "s/3.png", "seq_id": 7, "frame_num": 0},)"
                  R"({"id": "a", "file_name": "s/1.png", "seq_id": "night", "frame_num": 0}])",
                  "[]", "[]");
  CHECK(files_of(set) == Names{"s/1.png", "s/2.png", "s/3.png"});
  REQUIRE(set.videos.size() == 2);
  CHECK(set.videos[0].name == "night");
  CHECK(set.videos[1].name == "7");
}

TEST_CASE("Without keys the numbers in names order the frames") {
  const LabelSet set = read_family(
      R"([{"id": 1, "file_name": "v/f10.png"}, {"id": 2, "file_name": "v/f9.png"}, {"id": 3, "file_name": "v/f011.png"}])",
      "[]", "[]");
  CHECK(files_of(set) == Names{"v/f9.png", "v/f10.png", "v/f011.png"});
  CHECK(set.images[2].frame_index == 2);
  CHECK(set.videos[0].in_time);
  CHECK_FALSE(
      read_family(R"([{"id": 1, "file_name": "left.png"}, {"id": 2, "file_name": "right.png"}])", "[]", "[]")
          .videos[0]
          .in_time);
  CHECK(read_family(R"([{"id": 1, "file_name": "left.png"}])", "[]", "[]").videos[0].in_time);
}

TEST_CASE("An order of time that contradicts itself is a fault") {
  const auto with = [](const std::string& one, const std::string& other) {
    return family_fault(R"([{"id": 1, "file_name": "1.png", "video_id": 1)" + one +
                        R"(}, {"id": 2, "file_name": "2.png", "video_id": 1)" + other + "}]");
  };
  CHECK(with(R"(, "frame_id": 3)", R"(, "frame_id": 3)") ==
        "images[1].frame_id = 3; expected a frame other than that of images[0] of the same video");
  CHECK(with(R"(, "frame_id": 3)", "") ==
        "images[1].frame_id = nothing; expected one, as images[0] of the same video has");
  CHECK(with(R"(, "frame_index": 3, "frame_id": 4)", "") ==
        "images[0].frame_id = 4; expected 3, the picture's frame_index");
  CHECK(with(R"(, "frame_id": 1.5)", "") == "images[0].frame_id = 1.5; expected a whole number");
}

// --- ids -------------------------------------------------------------------------------------------------------------

TEST_CASE("Ids arrive as they left: of 64 bits, as text, or as floats that are whole") {
  const TestFolder folder;
  const LabelSet set = read_coco(folder.file("truth.json", R"({
      "categories": [{"id": 3735928559, "name": "human"}, {"id": "ele", "name": "elephant"}],
      "images": [{"id": "site1/0001", "file_name": "1.png"}, {"id": 9223372036854775807, "file_name": "2.png"}],
      "annotations": [
        {"id": "7f2c-a", "image_id": "site1/0001", "category_id": 3735928559.0, "bbox": [1, 2, 3, 4], "area": 12.0,
         "iscrowd": 0.0, "instance_id": 4294967295},
        {"id": -5, "image_id": 9223372036854775807, "category_id": "ele", "bbox": [1, 2, 3, 4]}]})"));
  CHECK(set.categories[0].id == LabelId(3735928559));
  CHECK(set.categories[1].id == LabelId("ele"));
  CHECK(set.images[0].id == LabelId("site1/0001"));
  CHECK(set.images[1].id == LabelId(9223372036854775807));
  CHECK(set.labels[0].id == LabelId("7f2c-a"));
  CHECK(set.labels[0].category == 0);
  CHECK(set.labels[0].track_id == std::optional<std::int64_t>(4294967295));
  CHECK(set.labels[1].image == 1);
  CHECK(set.labels[1].category == 1);
}

TEST_CASE("Ids that are none, or rounded, are faults, and 1 is not \"1\"") {
  CHECK(fault_with("/annotations/0/image_id", "20") ==
        "annotations[0].image_id = \"20\"; expected the id of one of the images");
  CHECK(fault_with("/images/1/id", 20.0) == "images[1].id = 20.0; expected an id other than that of entry 0");
  CHECK(fault_with("/images/1/id", true) == "images[1].id = true; expected a whole number or text");
  CHECK(fault_with("/images/1/id", 1e17) ==
        "images[1].id = 1e+17; expected a whole number; past 2^53 without \".\" and \"e\", which round it");
  CHECK(fault_with("/images/1/id", 1e300) == "images[1].id = 1e+300; expected a whole number");
  CHECK(fault_with("/annotations/0/area", {600}) == "annotations[0].area = [600]; expected a finite number");
}

// --- pictures without targets ----------------------------------------------------------------------------------------

TEST_CASE("An annotation called empty says that its picture has no targets") {
  const std::string images =
      R"([{"id": "a", "file_name": "1.png", "video_id": 1}, {"id": "b", "file_name": "2.png", "video_id": 1}])";
  const std::string elephant = R"({"id": 1, "image_id": "a", "category_id": 1, "bbox": [1, 2, 3, 4]})";
  const LabelSet set =
      read_family(images, "[" + elephant + R"(, {"id": 2, "image_id": "b", "category_id": 0}])");
  REQUIRE(set.labels.size() == 1);
  CHECK(set.images.size() == 2);
  REQUIRE(set.categories.size() == 1);
  CHECK(set.categories[set.labels[0].category].name == "elephant");
  CHECK(family_fault(images, "[" + elephant + R"(, {"id": 2, "image_id": "a", "category_id": 0}])") ==
        "annotations[0].image_id = \"a\"; expected a picture that annotations[1] does not call empty");
  CHECK(family_fault(images, R"([{"id": 2, "image_id": "b", "category_id": 1}])") ==
        "annotations[0].bbox = nothing; expected one, or category 0, \"empty\"");
}

TEST_CASE("A category called empty that has boxes is one like others") {
  const LabelSet set = read_family(R"([{"id": 1, "file_name": "1.png", "video_id": 1}])",
                                   R"([{"id": 1, "image_id": 1, "category_id": 0, "bbox": [1, 2, 3, 4]}])");
  CHECK(set.categories.size() == 2);
  CHECK(set.labels[0].category == 0);
}

// --- keys that change the meaning of others --------------------------------------------------------------------------

TEST_CASE("Keys of other formats that change the meaning are faults") {
  CHECK(fault_with("/annotations/0/bbox_mode", 0) ==
        "annotations[0].bbox_mode = 0; expected 1, a bbox of x, y, width and height in px, or none");
  CHECK(fault_with("/annotations/0/bbox_mode", 1) == "(no fault was thrown)");
  CHECK(fault_with("/annotations/0/score", 0.5) ==
        "annotations[0].score = 0.5; expected 1 or none: labels, not the results of a detector");
  CHECK(fault_with("/images/0/neg_category_ids", {2}) ==
        "images[0].neg_category_ids = [2]; expected none: labels of LVIS are incomplete on purpose");
  CHECK(fault_with("/images/0/detections", Json::array()) ==
        "images[0].detections = []; expected labels of COCO: this is a file of MegaDetector's results");
  CHECK(
      family_fault(R"([{"id": 1, "file_name": "1.png", "video_id": 1}])",
                   R"([{"id": 1, "image_id": 1, "category_id": 1, "bbox": [0.1, 0.2, 0.3, 0.4]}])") ==
      "annotations[0].bbox = [0.1, 0.2, 0.3, 0.4]; expected px; all boxes of the file are fractions of their "
      "pictures");
}

TEST_CASE("Other names of keys that are used") {
  const LabelSet set = read_family(
      R"([{"id": 1, "file_name": "1.png", "video_id": 1}])",
      R"([{"id": 1, "image_id": 1, "category_id": 1, "bbox": [1, 2, 3, 4], "instance_id": 8, "mot_conf": 0}])",
      R"([{"id": 1, "file_name": "MOT17-02", "fps": 30}])");
  CHECK(set.videos[0].name == "MOT17-02");
  CHECK(set.videos[0].frame_rate_hz == 30);
  CHECK(set.labels[0].track_id == std::optional<std::int64_t>(8));
  CHECK(set.labels[0].ignore);
}

// --- names of pictures -----------------------------------------------------------------------------------------------

TEST_CASE("Names of Windows are names in folders") {
  const LabelSet set = read_family(
      R"([{"id": 1, "file_name": "a\\b\\1.png"}, {"id": 2, "file_name": "a_b\\1.png"}])", "[]", "[]");
  CHECK(set.from_windows);
  CHECK(files_of(set) == Names{"a/b/1.png", "a_b/1.png"});
  REQUIRE(set.videos.size() == 2);  // one folder each, though both would be called a_b
  CHECK(set.videos[0].name == "a/b");
  CHECK(set.videos[1].name == "a_b");
}

TEST_CASE("Roundabout names are names in one folder") {
  const LabelSet set = read_family(
      R"([{"id": 1, "file_name": "./a/1.png"}, {"id": 2, "file_name": "a//2.png"}, {"id": 3, "file_name": "./3.png"}])",
      "[]", "[]");
  CHECK(set.videos.size() == 2);
  CHECK(flat_name(set, set.images[0]) == "a_1");
  CHECK(flat_name(set, set.images[1]) == "a_2");
  CHECK(flat_name(set, set.images[2]) == "truth_3");
}

}  // namespace coco_file_test
