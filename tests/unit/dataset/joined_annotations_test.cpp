#include "base/error.h"
#include "dataset/dataset_index.h"
#include "io/system/sha256.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace joined_annotations_test {

using namespace thermal;

namespace {

/// Labels of a clip with these frames, one target in each; the number of a clip's category is the clip's own.
Json document_of(const std::vector<int>& frames, int category = 1, const std::string& name = "human") {
  Json document = {{"info", {{"description", "clip"}}},
                   {"categories", Json::array({{{"id", category}, {"name", name}}})},
                   {"videos", Json::array({{{"id", 1}, {"name", "clip"}}})},
                   {"images", Json::array()},
                   {"annotations", Json::array()}};
  for (const int frame : frames) {
    document["images"].push_back(
        {{"id", frame + 1}, {"file_name", "ir8/picture.png"}, {"video_id", 1}, {"frame_index", frame}});
    document["annotations"].push_back({{"id", document["annotations"].size() + 1},
                                       {"image_id", frame + 1},
                                       {"category_id", category},
                                       {"area", 5},
                                       {"size_class", "small"}});
  }
  return document;
}

std::string joined_text(const std::vector<Json>& documents) {
  std::vector<ClipLabels> clips;
  for (const Json& document : documents) {
    clips.push_back({.clip = std::string(1, static_cast<char>('a' + clips.size())),
                     .source = "labels.json",
                     .read = [text = to_text(document)](const TakeElement& take) {
                       (void)parse_json_elements(text, "labels.json", take);
                     }});
  }
  std::string text;
  join_annotations("nights", clips, Spool(), [&text](std::string_view piece) { text += piece; });
  return text;
}

Json joined(const std::vector<Json>& documents) { return Json::parse(joined_text(documents)); }

}  // namespace

TEST_CASE("Joined documents have consecutive ids and files relative to the dataset's folder") {
  const Json document = joined({document_of({0, 1}), document_of({0, 1})});
  CHECK(document["info"].dump() == R"({"description":"nights","version":"1"})");
  REQUIRE(document["videos"].size() == 2);
  CHECK(document["videos"][1]["id"] == 2);
  REQUIRE(document["images"].size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(document["images"][i]["id"] == i + 1);
    CHECK(document["images"][i]["video_id"] == i / 2 + 1);
    CHECK(document["annotations"][i]["id"] == i + 1);
    CHECK(document["annotations"][i]["image_id"] == i + 1);
  }
  CHECK(document["images"][0]["file_name"] == "clips/a/ir8/picture.png");
  CHECK(document["images"][3]["file_name"] == "clips/b/ir8/picture.png");
}

TEST_CASE(
    "Frames that a clip goes without leave no two images with one id, and no label at another's image") {
  const Json document = joined({document_of({0, 2}), document_of({1}), document_of({})});
  std::vector<int> images;
  for (const Json& image : document["images"]) images.push_back(image["id"].get<int>());
  CHECK(images == std::vector{1, 3, 5});
  std::vector<int> labelled;
  for (const Json& annotation : document["annotations"])
    labelled.push_back(annotation["image_id"].get<int>());
  CHECK(labelled == images);
}

TEST_CASE("Joined labels keep all their properties, on one line") {
  const std::string text = joined_text({document_of({0}), document_of({0})});
  CHECK(text.ends_with(R"({"id":2,"image_id":2,"category_id":1,"area":5,"size_class":"small"}]})"
                       "\n"));
  CHECK(text == Json::parse(text).dump() + "\n");
  CHECK(
      joined_text({}) ==
      R"({"info":{"description":"nights","version":"1"},"categories":[],"videos":[],"images":[],"annotations":[]})"
      "\n");
}

TEST_CASE("A category keeps its name when clips number it differently") {
  const Json document = joined({document_of({0}, 11, "antelope"), document_of({0}, 11, "aardvark")});
  CHECK(document["categories"].dump() == R"([{"id":19,"name":"aardvark"},{"id":20,"name":"antelope"}])");
  CHECK(document["annotations"][0]["category_id"] == 20);
  CHECK(document["annotations"][1]["category_id"] == 19);
}

TEST_CASE("Images may precede what they refer to") {
  Json turned = Json::object();
  const Json usual = document_of({0});
  for (const char* key : {"images", "annotations", "videos", "categories"}) turned[key] = usual[key];
  CHECK(joined({turned, usual}) == joined({usual, usual}));
}

TEST_CASE("Labels of clips become a file with a checksum, and no other file is left") {
  const TestFolder folder;
  const Layout layout{folder.path()};
  make_folder(layout.clip("a"));
  (void)folder.file("clips/a/labels.json", to_text(document_of({0, 1})));
  const std::string sum = write_joined_annotations(layout, "nights", {"a"});
  const std::string text = read_file(layout.annotations_json());
  CHECK(text == joined_text({document_of({0, 1})}));
  CHECK(sum == sha256_of(text));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("Numbers that no clip of ours has are named") {
  const auto fault = [](const char* list, const char* key, const Json& value) {
    Json document = document_of({0});
    document[list][0][key] = value;
    return message_of<DataError>([&] { (void)joined({document}); });
  };
  CHECK(fault("images", "id", 1e308) == "labels.json: images[0].id = 1e+308; expected a whole number");
  CHECK(fault("annotations", "image_id", -1) ==
        "labels.json: annotations[0].image_id = -1; expected a whole number from 0 to 1000000000");
  CHECK(fault("annotations", "category_id", 7) ==
        "labels.json: annotations[0].category_id = 7; expected the id of one of its categories");
  CHECK(fault("categories", "name", 7) == "labels.json: categories[0].name = 7; expected a string");
}

TEST_CASE("Damaged or missing labels are named, and the existing file stays") {
  const TestFolder folder;
  const Layout layout{folder.path()};
  make_folder(layout.clip("a"));
  (void)folder.file("annotations.json", "before");
  const auto fault = [&] {
    try {
      (void)write_joined_annotations(layout, "nights", {"a"});
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Path labels = layout.clip("a") / "labels.json";
  CHECK(fault() == "cannot read " + labels.string() + ": No such file or directory");
  (void)folder.file("clips/a/labels.json", "{\"images\": [\n7");
  CHECK_THAT(fault(), StartsWith(labels.string() + ":2:2: not JSON: "));
  CHECK(read_file(layout.annotations_json()) == "before");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

}  // namespace joined_annotations_test
