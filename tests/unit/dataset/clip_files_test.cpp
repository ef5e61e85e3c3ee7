#include "dataset/clip_files.h"

#include <vector>

#include "base/error.h"
#include "dataset/clip/record.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace clip_files_test {

using namespace thermal;

namespace {

const char* const kLabels = R"({
  "categories": [{"id": 1, "name": "human"}],
  "images": [{"id": 1, "frame_index": 0}, {"id": 3, "frame_index": 2}],
  "annotations": [{"id": 1, "image_id": 3, "category_id": 1, "track_id": 7, "bbox": [1, 2, 3, 4], "area": 9,
                   "ignore": false, "segmentation": {"size": [6, 8], "counts": "a0"}}]})";

std::string without(const Path& folder, const std::string& message) {
  const std::string name = folder.string() + "/";
  return message.starts_with(name) ? message.substr(name.size()) : message;
}

/// Of the document with one value changed, `pointer` a JSON pointer; null removes it.
std::string label_fault(const std::string& pointer, const Json& value) {
  const TestFolder folder;
  Json document = parse_json(kLabels, "");
  document[Json::json_pointer(pointer)] = value;
  (void)folder.file("labels.json", document.dump());
  const auto ignore = [](int, const std::string&, const std::string&) {};
  return without(folder.path(), message_of<DataError>([&] { for_clip_labels(folder.path(), ignore); }));
}

std::string frame_fault(const std::string& lines) {
  const TestFolder folder;
  (void)folder.file("frames.jsonl", lines);
  return without(folder.path(),
                 message_of<DataError>([&] { for_clip_frames(folder.path(), [](int, const Json&) {}); }));
}

}  // namespace

TEST_CASE("Annotations are handed over with their frame and category") {
  const TestFolder folder;
  (void)folder.file("labels.json", kLabels);
  int count = 0;
  for_clip_labels(folder.path(), [&](int frame_index, const std::string& category, const std::string& text) {
    ++count;
    CHECK(frame_index == 2);
    CHECK(category == "human");
    CHECK(parse_json(text, "") == parse_json(kLabels, "")["annotations"][0]);
  });
  CHECK(count == 1);
}

TEST_CASE("An annotation that readers could not use is refused with its place") {
  const std::string at = "labels.json: annotations[0].";
  CHECK(label_fault("/annotations/0/image_id", 2) ==
        at + "image_id = 2; expected the id of an entry of the file");
  CHECK(label_fault("/annotations/0/category_id", 5).starts_with(at + "category_id = 5; expected the id"));
  CHECK(label_fault("/annotations/0/track_id", "7") == at + "track_id = \"7\"; expected a whole number");
  CHECK(label_fault("/annotations/0/ignore", nullptr) == at + "ignore = null; expected false or true");
  CHECK(label_fault("/annotations/0/bbox", {1, 2}).starts_with(at + "bbox = [1,2]; expected x, y, width"));
  for (const Json& mask :
       {Json(), Json::array({Json::array({1, 2})}), Json{{"size", {1, -1}}, {"counts", "0"}},
        Json{{"size", {1, 5'000'000'000}}, {"counts", "0"}}, Json{{"size", {1, 1}}, {"counts", {0}}}})
    CHECK_THAT(label_fault("/annotations/0/segmentation", mask),
               EndsWith("expected an object with size, [height, width], and counts, a text"));
  CHECK(label_fault("/images/0", 5) == "labels.json: images[0] = 5; expected an object");
  CHECK(label_fault("/annotations", nullptr) ==
        "labels.json: no list \"annotations\"; expected the labels of a clip");
  CHECK(label_fault("/categories/0/name", 5) == "labels.json: categories[0].name = 5; expected a string");
}

TEST_CASE("Lines of frames are checked") {
  const std::string good = R"({"frame_index": 3, "time_s": 0.1, "ffc": false, "camera_to_world": null})";
  const TestFolder folder;
  (void)folder.file("frames.jsonl", good + "\n" + R"({"frame_index": 5, "time_s": 0.2, "ffc": true})" + "\n");
  std::vector<int> frames;
  for_clip_frames(folder.path(), [&](int frame_index, const Json&) { frames.push_back(frame_index); });
  CHECK(frames == std::vector<int>{3, 5});

  CHECK(frame_fault("3\n") == "frames.jsonl: line[1] = 3; expected an object");
  CHECK(frame_fault(good + "\n" + good) == "frames.jsonl: line[2].frame_index = 3; expected above 3");
  CHECK(frame_fault(R"({"frame_index": 3})") == "frames.jsonl: line[1].time_s = nothing; expected one");
  CHECK_THAT(frame_fault(R"({"frame_index": 3, "time_s": 1, "camera_to_world": [1, 2]})"),
             EndsWith("camera_to_world = [1,2]; expected 16 numbers"));
  CHECK_THAT(frame_fault("{"), ContainsSubstring("frames.jsonl:1: not a frame of a clip"));
}

TEST_CASE("Links in a clip are not followed") {
  const TestFolder folder;
  const Path elsewhere = folder.file("elsewhere", kLabels);
  const Path clip = folder.path() / "clip";
  std::filesystem::create_directory(clip);
  for (const char* name : {"labels.json", "frames.jsonl"})
    std::filesystem::create_symlink(elsewhere, clip / name);
  const auto ignore = [](int, const std::string&, const std::string&) {};
  CHECK_THAT(message_of<IoError>([&] { for_clip_labels(clip, ignore); }), ContainsSubstring("labels.json"));
  CHECK_THAT(message_of<IoError>([&] { for_clip_frames(clip, [](int, const Json&) {}); }),
             ContainsSubstring("frames.jsonl"));
  CHECK_THAT(message_of<IoError>([&] { (void)read_clip_record(clip / "clip.json"); }),
             ContainsSubstring("link"));
}

}  // namespace clip_files_test
