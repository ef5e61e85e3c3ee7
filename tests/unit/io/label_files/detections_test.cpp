#include "io/label_files/detections.h"

#include <filesystem>

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace detections_files_test {

using namespace thermal;

namespace {

/// Two pictures of a clip, ids 11 and 12.
LabelSet truth() {
  LabelSet set;
  set.categories = {{1, "human"}, {5, "elephant"}};
  set.videos = {{"winter"}};
  for (const int frame : {0, 1}) {
    LabelImage image;
    image.id = 11 + frame;
    image.file = std::string("clips/winter/ir8/00000") + std::to_string(frame) + ".png";
    image.width_px = 640;
    image.height_px = 512;
    image.frame_index = frame;
    set.images.push_back(image);
  }
  return set;
}

constexpr const char* kGood = R"({"image_id": 12, "category_id": 5, "bbox": [1, 2.5, 3, 4], "score": 0.75})";

std::vector<Detection> read_text(const std::string& text) {
  const TestFolder folder;
  return read_detections(folder.file("found.json", text), truth());
}

/// The message for a results file, without its folder.
std::string fault_of(const std::string& text) {
  const TestFolder folder;
  const std::string file = folder.file("found.json", text).string();
  const std::string message = message_of<DataError>([&] { (void)read_detections(file, truth()); });
  return message.starts_with(file) ? message.substr(file.size() - 10) : message;
}

/// The message for a picture's YOLO results, without their folder.
std::string yolo_fault(const std::string& text, const std::string& name = "winter_000001.txt",
                       const LabelSet& set = truth()) {
  const TestFolder folder;
  const std::string file = folder.file(name, text).string();
  const std::string message = message_of<DataError>([&] { (void)read_detections(folder.path(), set); });
  return message.starts_with(file) ? message.substr(file.size() - name.size()) : message;
}

constexpr const char* kNoList =
    R"(found.json: no list of detections; expected [{"image_id", "category_id", "bbox", "score"}, …])";

}  // namespace

TEST_CASE("COCO results are read in their order") {
  const auto found = read_text(std::string("[") + kGood +
                               R"(, {"id": 7, "score": 1, "category_id": 1, "image_id": 11, "bbox": [0,0,9,9],
                                     "segmentation": {"size": [512, 640], "counts": "PPYo1"}}])");
  REQUIRE(found.size() == 2);
  CHECK(found[0].image == 1);
  CHECK(found[0].category == 1);
  CHECK(found[0].box == LabelBox{1, 2.5, 3, 4});
  CHECK(found[0].score == 0.75);
  CHECK(found[1].image == 0);
  CHECK(found[1].category == 0);
  CHECK(found[1].score == 1);
}

TEST_CASE("An empty list of results is valid") {
  CHECK(read_text("[]").empty());
  CHECK(read_text(" [ ] \n").empty());
  const TestFolder folder;
  CHECK(read_detections(folder.path(), truth()).empty());
}

TEST_CASE(
    "Detections may be repeated, have any score, and boxes that extend beyond the picture or have no area") {
  const auto entry = [](const std::string& box, const std::string& score) {
    return R"({"image_id": 12, "category_id": 5, "bbox": )" + box + R"(, "score": )" + score + "}";
  };
  const auto found =
      read_text(std::string("[") + entry("[-5, -5, 10, 10]", "0") + "," + entry("[-5, -5, 10, 10]", "0") +
                "," + entry("[630, 500, 100, 100]", "-17.5") + "," + entry("[640, 512, 0, 0]", "1e300") +
                "," + entry("[-3, 0, 3, 5]", "2") + "]");
  CHECK(found.size() == 5);
}

TEST_CASE("Results that are not a list of detections are refused") {
  CHECK(fault_of("{}") == kNoList);
  CHECK(fault_of(R"({"images": [{"id": 1}], "annotations": []})") == kNoList);
  CHECK(fault_of("7") == kNoList);
  CHECK(fault_of("[1]") == "found.json: [0] = 1; expected an object");
  CHECK(fault_of(std::string("[") + kGood + ", [1, 2]]") == "found.json: [1] = [1,2]; expected an object");
}

TEST_CASE("Unknown pictures and categories are named") {
  CHECK(fault_of(R"([{"image_id": 13, "category_id": 5, "bbox": [1, 2, 3, 4], "score": 1}])") ==
        "found.json: [0].image_id = 13; expected the id of one of the truth's pictures");
  CHECK(fault_of(std::string("[") + kGood +
                 R"(, {"image_id": 12, "category_id": 2, "bbox": [1, 2, 3, 4], "score": 1}])") ==
        "found.json: [1].category_id = 2; expected one of 1 (human), 5 (elephant)");
  CHECK(fault_of(R"([{"image_id": 12, "category_id": "elefant", "bbox": [1, 2, 3, 4], "score": 1}])") ==
        "found.json: [0].category_id = \"elefant\"; expected one of 1 (human), 5 (elephant); did you mean "
        "\"elephant\"?");
  CHECK(fault_of(R"([{"image_id": "12", "category_id": 5, "bbox": [1, 2, 3, 4], "score": 1}])") ==
        "found.json: [0].image_id = \"12\"; expected the id or the name of one of the truth's pictures");
}

TEST_CASE("Scores that are not finite numbers are named") {
  const auto with_score = [](const std::string& score) {
    return std::string("[") + kGood + ",\n" + R"({"image_id": 12, "category_id": 5, "bbox": [1, 2, 3, 4])" +
           (score.empty() ? "" : R"(, "score": )" + score) + "}]";
  };
  CHECK(fault_of(with_score("null")) == "found.json: [1].score = null; expected a finite number");
  CHECK(fault_of(with_score("\"0.5\"")) == "found.json: [1].score = \"0.5\"; expected a finite number");
  CHECK(fault_of(with_score("true")) == "found.json: [1].score = true; expected a finite number");
  CHECK(fault_of(with_score("")) == "found.json: [1].score = nothing; expected one");
  CHECK(fault_of(with_score("1e999")) == "found.json: not JSON: number overflow parsing '1e999'");
}

TEST_CASE("NaN and Infinity, which Python writes, are located and explained") {
  const std::string rule =
      "; expected a finite number: JSON has no NaN and no Infinity, though Python writes them";
  const auto ends_of = [&rule](const std::string& score) {
    const std::string message = fault_of("[\n{\"score\": " + score + "}]");
    CHECK(message.ends_with(rule));
    return message.substr(0, message.find(": syntax error"));
  };
  CHECK(ends_of("NaN") == "found.json:2:11: not JSON");
  CHECK(ends_of("Infinity") == "found.json:2:11: not JSON");
  CHECK(ends_of("-Infinity") == "found.json:2:12: not JSON");
  CHECK_FALSE(fault_of("[\n{\"score\": oops}]").ends_with(rule));
  CHECK(fault_of("[").starts_with("found.json:1:2: not JSON: syntax error"));
  CHECK(fault_of("") == "found.json:1:1: not JSON: it is empty");
}

TEST_CASE("Invalid boxes are named") {
  const auto with_box = [](const std::string& box) {
    return R"([{"image_id": 12, "category_id": 5, "score": 0.5, "bbox": )" + box + "}]";
  };
  const std::string form = "; expected x, y, width and height in px, the last two not negative";
  const std::string inside = "; expected a box that touches its picture, 640 x 512 px";
  CHECK(fault_of(with_box("[1, 2, 3]")) == "found.json: [0].bbox = [1,2,3]" + form);
  CHECK(fault_of(with_box("[1, 2, 3, null]")) == "found.json: [0].bbox = [1,2,3,null]" + form);
  CHECK(fault_of(with_box("[1, 2, -3, 4]")) == "found.json: [0].bbox = [1,2,-3,4]" + form);
  CHECK(fault_of(with_box("[641, 2, 3, 4]")) == "found.json: [0].bbox = [641,2,3,4]" + inside);
  CHECK(fault_of(with_box("[1, 513, 3, 4]")) == "found.json: [0].bbox = [1,513,3,4]" + inside);
  CHECK(fault_of(with_box("[-4, 2, 3, 4]")) == "found.json: [0].bbox = [-4,2,3,4]" + inside);
  CHECK(fault_of(with_box("[1, -5, 3, 4]")) == "found.json: [0].bbox = [1,-5,3,4]" + inside);
}

TEST_CASE("In pictures of unknown size, boxes may be anywhere except left and above") {
  LabelSet set = truth();
  for (LabelImage& image : set.images) image.width_px = image.height_px = 0;
  const TestFolder folder;
  const auto read = [&](const std::string& box) {
    const auto file = folder.file(
        "found.json", R"([{"image_id": 12, "category_id": 5, "score": 0.5, "bbox": )" + box + "}]");
    return read_detections(file, set).size();
  };
  CHECK(read("[5000, 5000, 1, 1]") == 1);
  CHECK(message_of<DataError>([&] { (void)read("[-2, 0, 1, 1]"); }) ==
        (folder / "found.json").string() +
            ": [0].bbox = [-2,0,1,1]; expected a box that is not to the left of its picture or above it");
}

TEST_CASE("YOLO results are scaled to their pictures") {
  const TestFolder folder;
  (void)folder.file("winter_000001.txt",
                    "\xEF\xBB\xBF"
                    "1 0.5 0.25 0.125 0.5 0.75\r\n\n  0\t1 1 0 0 1e-3  \n0 0 0 .5 .5 1");
  (void)folder.file("notes.md", "not read");
  const auto found = read_detections(folder.path(), truth());
  REQUIRE(found.size() == 3);
  CHECK(found[0].image == 1);
  CHECK(found[0].category == 1);
  CHECK(found[0].box == LabelBox{0.4375 * 640, 0, 80, 256});
  CHECK(found[0].score == 0.75);
  CHECK(found[1].category == 0);
  CHECK(found[1].box == LabelBox{640, 512, 0, 0});
  CHECK(found[2].box == LabelBox{-160, -128, 320, 256});
}

TEST_CASE("YOLO results may use the picture's own name if it is unique") {
  LabelSet set = truth();
  CHECK(yolo_fault("", "000001.txt", set) == "(no fault was thrown)");
  set.videos.push_back({"summer"});
  set.images.push_back(set.images[1]);
  set.images.back().video = 1;
  CHECK(yolo_fault("", "000000.txt", set) == "(no fault was thrown)");
  CHECK(yolo_fault("", "summer_000001.txt", set) == "(no fault was thrown)");
  CHECK(yolo_fault("", "000001.txt", set)
            .starts_with("000001.txt: names no picture of the truth; expected VIDEO_PICTURE.txt"));
}

TEST_CASE("YOLO files that match no picture are refused") {
  CHECK(yolo_fault("", "winter_00001.txt") ==
        "winter_00001.txt: names no picture of the truth; expected VIDEO_PICTURE.txt; did you mean "
        "\"winter_000001\"?");
  CHECK(yolo_fault("", "classes.txt") ==
        "classes.txt: names no picture of the truth; expected VIDEO_PICTURE.txt");
  CHECK(yolo_fault("", "winter_000001.json")
            .ends_with(": no .txt files; expected YOLO results, one file per picture"));
}

TEST_CASE("Faults of YOLO results are located") {
  CHECK(yolo_fault("0 .5 .5 .1 .1 1\n0 .5 .5 .1 .1\n") ==
        "winter_000001.txt:2 = 5 words; expected class cx cy w h score");
  CHECK(yolo_fault("2 .5 .5 .1 .1 1") ==
        "winter_000001.txt:1: class = 2; expected one of 0 (human), 1 (elephant)");
  CHECK(yolo_fault("elephant .5 .5 .1 .1 1") ==
        "winter_000001.txt:1: class = elephant; expected one of 0 (human), 1 (elephant)");
  CHECK(yolo_fault("-1 .5 .5 .1 .1 1").starts_with("winter_000001.txt:1: class = -1; expected "));
  CHECK(yolo_fault("0 .5 .5 .1 .1 nan") == "winter_000001.txt:1: score = nan; expected a finite number");
  CHECK(yolo_fault("0 .5 inf .1 .1 1") == "winter_000001.txt:1: cy = inf; expected a finite number");
  CHECK(yolo_fault("0 .5 .5 .1 .1 1e999") == "winter_000001.txt:1: score = 1e999; expected a finite number");
  CHECK(yolo_fault("0 .5,5 .5 .1 .1 1") == "winter_000001.txt:1: cx = .5,5; expected a finite number");
  CHECK(yolo_fault("0 .5 .5 -.1 .1 1") == "winter_000001.txt:1: w = -.1; expected at least 0");
  CHECK(yolo_fault("0 .5 .5 .1 -.1 1") == "winter_000001.txt:1: h = -.1; expected at least 0");
  const std::string touching = "; expected a box that touches its picture, 640 x 512 px";
  CHECK(yolo_fault("0 0 .5 1e308 .1 1") == "winter_000001.txt:1: box = [0, .5, 1e308, .1]" + touching);
  CHECK(yolo_fault("0 .5 .5 .1 3.6e305 1") == "winter_000001.txt:1: box = [.5, .5, .1, 3.6e305]" + touching);
  CHECK(
      yolo_fault("\n\n0 1.5 .5 .1 .1 1") ==
      "winter_000001.txt:3: box = [1.5, .5, .1, .1]; expected a box that touches its picture, 640 x 512 px");
}

TEST_CASE("YOLO results need the pictures' sizes") {
  LabelSet set = truth();
  set.images[1].width_px = 0;
  CHECK(yolo_fault("", "winter_000001.txt", set) ==
        "winter_000001.txt: the truth lacks the size of clips/winter/ir8/000001.png; expected it, because "
        "YOLO boxes are relative to it");
}

TEST_CASE("Missing results cannot be read") {
  const TestFolder folder;
  const std::string file = (folder / "found.json").string();
  CHECK(message_of<IoError>([&] { (void)read_detections(file, truth()); }) ==
        "cannot read " + file + ": No such file or directory");
}

// --- names instead of ids, as Ultralytics writes them -----------------------------------------------------------------

namespace {

/// Three pictures of a folder and one of another, ids from 0, and three categories of which the ids have a gap.
LabelSet folders_truth() {
  LabelSet set;
  set.categories = {{1, "human"}, {2, "elephant"}, {5, "zebra"}};
  set.videos = {{"night"}, {"day"}};
  const std::vector<std::string> files = {"night/0001.png", "night/0002.png", "night/0003.png",
                                          "day/0001.png"};
  for (std::size_t i = 0; i < files.size(); ++i)
    set.images.push_back({.id = static_cast<std::int64_t>(i),
                          .file = files[i],
                          .width_px = 640,
                          .height_px = 512,
                          .video = i < 3 ? std::size_t{0} : std::size_t{1}});
  return set;
}

/// A results file of entries with these keys, each beside a box and a score.
std::string entries(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys)
    text += (text.empty() ? "[" : ",\n") + ("{" + key + R"(, "bbox": [1, 2, 3, 4], "score": 0.9})");
  return text + "]";
}

std::vector<Detection> read_entries(const std::vector<std::string>& keys,
                                    const LabelSet& set = folders_truth()) {
  const TestFolder folder;
  return read_detections(folder.file("found.json", entries(keys)), set);
}

std::string fault_of_entries(const std::vector<std::string>& keys, const LabelSet& set = folders_truth()) {
  const std::string message = message_of<DataError>([&] { (void)read_entries(keys, set); });
  const std::size_t name = message.find("found.json: ");
  return name == std::string::npos ? message : message.substr(name + 12);
}

}  // namespace

TEST_CASE("Pictures are found by names, and categories by their places then") {
  const auto found =
      read_entries({R"("image_id": "night_0001", "file_name": "night_0001.png", "category_id": 1)",
                    R"("image_id": "0002", "file_name": "0002.png", "category_id": 2)",
                    R"("image_id": "day_0001", "file_name": "sets\\day\\0001.jpg", "category_id": 3)",
                    R"("image_id": "night/0003", "category_id": 3)",
                    R"("image_id": 77, "file_name": "0003.png", "category_id": 3)"});
  REQUIRE(found.size() == 5);
  CHECK((found[0].image == 0 && found[1].image == 1 && found[2].image == 3));
  CHECK((found[3].image == 2 && found[4].image == 2));
  CHECK((found[0].category == 0 && found[1].category == 1 && found[2].category == 2));
}

TEST_CASE("image_id and file_name must be of one picture") {
  CHECK(fault_of_entries({R"("image_id": 1, "file_name": "0001.png", "category_id": 1)"}) ==
        "[0].image_id = 1; expected the id of its file_name, \"0001.png\", and not of night/0002.png");
  CHECK(fault_of_entries({R"("image_id": "night_0002", "file_name": "night_0001.png", "category_id": 1)"}) ==
        "[0].image_id = \"night_0002\"; expected the id of its file_name, \"night_0001.png\", and not of "
        "night/0002.png");
  CHECK(fault_of_entries({R"("image_id": 0, "file_name": "day/0001.png", "category_id": 1)"}) ==
        "[0].image_id = 0; expected the id of its file_name, \"day/0001.png\", and not of night/0001.png");
  CHECK(
      read_entries({R"("image_id": 3, "file_name": "/data/sets/day/0001.png", "category_id": 5)"})[0].image ==
      3);
}

TEST_CASE("Names that are none, or of two pictures, are faults") {
  CHECK(fault_of_entries({R"("image_id": "nigth_0001", "category_id": 1)"}) ==
        "[0].image_id = \"nigth_0001\"; expected the id or the name of one of the truth's pictures; did you "
        "mean "
        "\"night_0001\"?");
  CHECK(fault_of_entries({R"("image_id": 9, "file_name": "0001.png", "category_id": 1)"}) ==
        "[0].file_name = \"0001.png\"; expected the id or the name of one of the truth's pictures");
  LabelSet set = folders_truth();
  set.images[3].file = "night_0001.png";
  set.images[2].file = "a/night_0001.png";
  set.videos[1].name = set.videos[0].name = "x";
  CHECK(fault_of_entries({R"("image_id": "x_night_0001", "category_id": 1)"}, set) ==
        "[0].image_id: \"x_night_0001\" is both a/night_0001.png and night_0001.png; expected names that "
        "differ");
}

TEST_CASE("Categories are ids where pictures are") {
  CHECK(read_entries({R"("image_id": 3, "category_id": 5)"})[0].category == 2);
  CHECK(fault_of_entries({R"("image_id": 3, "category_id": 3)"}) ==
        "[0].category_id = 3; expected one of 1 (human), 2 (elephant), 5 (zebra)");
  // A name that only counts places, and one that has ids.
  CHECK(
      fault_of_entries({R"("image_id": "0002", "file_name": "0002.png", "category_id": 5)"}) ==
      "[0].category_id = 5; expected one of 1 (human), 2 (elephant), 3 (zebra), counted as Ultralytics does");
  CHECK(read_entries({R"("image_id": "0002", "category_id": 5)"})[0].category == 2);
  // The stem of the name is the id.
  CHECK(read_entries({R"("image_id": 2, "file_name": "0002.png", "category_id": 3)"},
                     [] {
                       LabelSet set = folders_truth();
                       for (LabelImage& image : set.images) image.id = std::get<std::int64_t>(image.id) + 1;
                       return set;
                     }())[0]
            .category == 2);
}

TEST_CASE("Categories that may be ids or places are refused, unless both are the same") {
  LabelSet set = folders_truth();
  set.categories = {{0, "human"}, {1, "elephant"}};
  CHECK(fault_of_entries({R"("image_id": "0002", "category_id": 1)"}, set) ==
        "[0].category_id = 1; expected a number of one meaning: it is the id of elephant and, as Ultralytics "
        "counts, "
        "human");
  CHECK(read_entries({R"("image_id": "0002", "file_name": "0002.png", "category_id": 1)"}, set)[0].category ==
        0);
  CHECK(read_entries({R"("image_id": "0002", "category_id": 1)", R"("image_id": "0003", "category_id": 0)"},
                     set)[0]
            .category == 1);
  CHECK(read_entries({R"("image_id": "0002", "category_id": 1)"})[0].category == 0);
}

TEST_CASE("Ids that are texts or floats are ids") {
  LabelSet set = folders_truth();
  set.images[1].id = "site1/0002";
  set.categories[1].id = "ele";
  const auto found = read_entries(
      {R"("image_id": "site1/0002", "category_id": "ele")", R"("image_id": 3.0, "category_id": 5.0)"}, set);
  CHECK((found[0].image == 1 && found[0].category == 1));
  CHECK((found[1].image == 3 && found[1].category == 2));
  CHECK(fault_of_entries({R"("image_id": 1.5, "category_id": 5)"}) ==
        "[0].image_id = 1.5; expected a whole number");
}

TEST_CASE("Boxes of other kinds are refused by name") {
  CHECK(fault_of(R"([{"image_id": 12, "category_id": 5, "score": 0.5, "bbox": [0.1, 0.2, 0.3, 0.4]}])")
            .ends_with("found.json: all boxes are fractions of their pictures; expected boxes in px"));
  CHECK(fault_of(
            R"([{"image_id": 12, "category_id": 5, "score": 0.5, "bbox": [1, 2, 3, 4], "bbox_mode": 0}])") ==
        "found.json: [0].bbox_mode = 0; expected 1, a bbox of x, y, width and height in px, or none");
  CHECK(
      fault_of(
          R"({"images": [{"file": "1.png", "detections": []}], "detection_categories": {"1": "animal"}})") ==
      "found.json: results of MegaDetector, whose boxes are fractions of pictures; expected COCO's");
}

}  // namespace detections_files_test
