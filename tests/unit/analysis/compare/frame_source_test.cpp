#include "analysis/compare/frame_source.h"

#include "base/error.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/test_folder.h"

namespace frame_source_test {

using namespace thermal;

namespace {

/// Labels of a picture 1.png in each of these folders, the box of the nth n px wide, beside the folders.
Path write_labels(const TestFolder& place, const std::vector<std::string>& folders) {
  std::string images;
  std::string annotations;
  for (std::size_t k = 0; k < folders.size(); ++k) {
    const std::string id = std::to_string(k + 1);
    const std::string comma = k > 0 ? "," : "";
    images += comma + R"({"id":)" + id + R"(,"file_name":")" + folders[k] + R"(\\1.png"})";
    annotations +=
        comma + R"({"id":)" + id + R"(,"image_id":)" + id + R"(,"category_id":1,"bbox":[0,0,)" + id + ",9]}";
  }
  return place.file("annotations.json", R"({"categories":[{"id":1,"name":"human"}],"images":[)" + images +
                                            R"(],"annotations":[)" + annotations + "]}");
}

}  // namespace

TEST_CASE("Of pictures of one name, a folder has its own") {
  const TestFolder place;
  (void)write_labels(place, {"day", "night"});
  for (const std::string folder : {"day", "night"}) {
    std::filesystem::create_directory(place / folder);
    (void)place.file(folder + "/1.png", "a picture");
    const FrameSource source = read_frame_source({.source = place / folder});
    REQUIRE(source.frames.size() == 1);
    REQUIRE(source.frames[0].boxes.size() == 1);
    CHECK(source.frames[0].boxes[0].width_px == (folder == "day" ? 1 : 2));
  }
}

TEST_CASE("A picture of several names elsewhere is a fault") {
  const TestFolder place;
  const Path labels = write_labels(place, {"day", "night"});
  std::filesystem::create_directory(place / "other");
  (void)place.file("other/1.png", "a picture");
  CHECK(message_of<DataError>([&] { (void)read_frame_source({.source = place / "other"}); }) ==
        labels.string() +
            ": 1.png may be any of day/1.png, night/1.png; expected one picture of this name, or one in " +
            (place / "other").string());
}

}  // namespace frame_source_test
