#include "labels/label_set.h"

#include "support/catch.h"

namespace label_set_test {

using namespace thermal;

namespace {

Label label(std::size_t image, std::optional<std::int64_t> track_id, double width_px, double height_px) {
  Label made;
  made.image = image;
  made.track_id = track_id;
  made.box = {0, 0, width_px, height_px};
  return made;
}

LabelImage picture(std::size_t video) {
  LabelImage made;
  made.video = video;
  return made;
}

}  // namespace

TEST_CASE("A track's size is the mean of its boxes over its video") {
  LabelSet set;
  set.videos = {{.name = "a"}, {.name = "b"}};
  set.images = {picture(0), picture(0), picture(1)};
  set.labels = {label(0, 1, 10, 10), label(1, 1, 10, 30),    // mean 200: medium
                label(0, 2, 10, 10), label(1, 2, 10, 29.9),  // just below
                label(0, 3, 50, 40), label(2, 3, 50, 40.1),  // 2000 in one video, more in the other
                label(2, {}, 1, 1),  label(2, {}, 100, 100)};
  assign_size_classes(set);
  using enum SizeClass;
  const std::vector<SizeClass> expected = {medium, medium, small, small, medium, large, small, large};
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(set.labels[i].size == expected[i]);
}

TEST_CASE("A flat name is the video's and the picture's") {
  LabelSet set;
  set.videos = {{.name = "winter"}};
  set.images = {{.id = 1, .file = "clips/winter/ir8/000012.png"}, {.id = 2, .file = "plain"}};
  CHECK(flat_name(set, set.images[0]) == "winter_000012");
  CHECK(flat_name(set, set.images[1]) == "winter_plain");
  set.videos[0].name = "2026/winter";
  CHECK(flat_name(set, set.images[0]) == "2026_winter_000012");
  set.videos[0].name = "2026\\winter";
  CHECK(flat_name(set, set.images[0]) == "2026_winter_000012");
}

TEST_CASE("Ids are numbers or texts, and say which") {
  CHECK(id_text(LabelId(-7)) == "-7");
  CHECK(id_text(LabelId("7")) == "\"7\"");
  CHECK(LabelId(7) != LabelId("7"));
  CHECK(LabelId(9) < LabelId("1"));
}

TEST_CASE("Boxes within the first pixel, not all of whole numbers, are fractions of their pictures") {
  const auto boxed = [](const std::vector<LabelBox>& boxes) {
    std::vector<Label> labels(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) labels[i].box = boxes[i];
    return are_fractions(labels);
  };
  CHECK(boxed({{0.25, 0.5, 0.75, 0.5}, {0, 0, 1, 1}}));
  CHECK_FALSE(boxed({{0.25, 0.5, 0.75, 0.5}, {0, 0, 1, 1.5}}));
  CHECK_FALSE(boxed({{-0.25, 0.5, 0.75, 0.5}}));
  CHECK_FALSE(boxed({{0, 0, 1, 1}}));
  CHECK_FALSE(boxed({}));
}

TEST_CASE("People are humans, vehicles vehicles, everything else animals") {
  CHECK(kind_of("human") == Kind::human);
  CHECK(kind_of("person") == Kind::human);
  CHECK(kind_of("vehicle") == Kind::vehicle);
  CHECK(kind_of("bicycle") == Kind::vehicle);
  CHECK(kind_of("motorbike") == Kind::vehicle);
  CHECK(kind_of("elephant") == Kind::animal);
}

}  // namespace label_set_test
