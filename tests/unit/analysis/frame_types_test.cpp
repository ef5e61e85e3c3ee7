#include "analysis/balance/program.h"
#include "support/catch.h"

namespace frame_types_test {

using namespace thermal;

namespace {

/// A set of one video; images are added frame by frame.
struct Night {
  LabelSet set;

  Night() {
    set.categories = {{1, "elephant"}, {2, "human"}, {3, "vehicle"}, {4, "poacher"}};
    set.videos = {{.name = "night"}};
  }
  /// The order of frames is arbitrary.
  void add_frame(int frame, const std::vector<Label>& labels) {
    LabelImage image;
    image.frame_index = frame;
    set.images.push_back(image);
    for (Label label : labels) {
      label.image = set.images.size() - 1;
      set.labels.push_back(label);
    }
  }
};

Label label_of(std::size_t category, SizeClass size) {
  Label label;
  label.category = category;
  label.size = size;
  return label;
}

const Label kSmallElephant = label_of(0, SizeClass::small);
const Label kLargeElephant = label_of(0, SizeClass::large);
const Label kMediumHuman = label_of(1, SizeClass::medium);
const Label kLargePoacher = label_of(3, SizeClass::large);
const Label kVehicle = label_of(2, SizeClass::large);

}  // namespace

TEST_CASE("frames with the same counts have one type") {
  Night night;
  night.add_frame(7, {kSmallElephant, kMediumHuman});
  night.add_frame(2, {kMediumHuman, kSmallElephant});
  night.add_frame(3, {kLargePoacher});
  night.add_frame(4, {kLargeElephant, kLargeElephant, kVehicle});
  const std::vector<BalanceVideo> videos = frame_types(night.set);
  REQUIRE(videos.size() == 1);
  CHECK(videos[0].name == "night");
  REQUIRE(videos[0].types.size() == 3);
  CHECK(videos[0].types[0].labels == ClassCounts{0, 0, 0, 0, 0, 1});
  CHECK(videos[0].types[1].labels == ClassCounts{0, 0, 2, 0, 0, 0});
  CHECK(videos[0].types[2].labels == ClassCounts{1, 0, 0, 0, 1, 0});
  CHECK(videos[0].types[2].frames == std::vector<int>{2, 7});
  CHECK(videos[0].available() == ClassCounts{2, 0, 2, 0, 2, 1});
  CHECK(videos[0].unlabelled == 0);
}

TEST_CASE("ignored labels, crowds and vehicles are not counted") {
  Night night;
  Label ignored = kSmallElephant;
  ignored.ignore = true;
  Label crowd = kSmallElephant;
  crowd.crowd = true;
  night.add_frame(0, {});
  night.add_frame(1, {ignored});
  night.add_frame(2, {crowd, kVehicle});
  night.add_frame(3, {ignored, kSmallElephant});
  const BalanceVideo video = frame_types(night.set).front();
  CHECK(video.unlabelled == 3);
  REQUIRE(video.types.size() == 1);
  CHECK(video.types[0].frames == std::vector<int>{3});
  CHECK(video.available() == ClassCounts{1});
}

TEST_CASE("videos without frames are kept") {
  LabelSet set;
  set.videos = {{.name = "one"}, {.name = "two"}};
  const std::vector<BalanceVideo> videos = frame_types(set);
  REQUIRE(videos.size() == 2);
  CHECK(videos[1].name == "two");
  CHECK(videos[1].types.empty());
}

}  // namespace frame_types_test
