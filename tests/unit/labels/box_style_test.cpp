#include "labels/box_style.h"

#include "support/catch.h"

namespace box_style_test {

using namespace thermal;

namespace {

LabelSet set_of(const LabelBox& box, const std::string& category = "human") {
  LabelSet set;
  set.images = {{.id = 1, .file = "a.png", .width_px = 100, .height_px = 80}};
  Label label;
  label.box = box;
  label.area_px = 30;
  set.labels = {label};
  set.categories = {{.id = 1, .name = category}};
  return set;
}

LabelBox drawn(const LabelBox& box) {
  LabelSet set = set_of(box);
  widen_as_drawn(set);
  CHECK(set.labels[0].area_px == 30);
  return set.labels[0].box;
}

void check_box(const LabelBox& found, const LabelBox& expected) {
  CHECK_THAT(found.x_px, WithinAbs(expected.x_px, 1e-12));
  CHECK_THAT(found.y_px, WithinAbs(expected.y_px, 1e-12));
  CHECK_THAT(found.width_px, WithinAbs(expected.width_px, 1e-12));
  CHECK_THAT(found.height_px, WithinAbs(expected.height_px, 1e-12));
}

}  // namespace

TEST_CASE("Margins grow with the target up to two pixels") {
  CHECK_THAT(drawn_margin_px({0, 0, 7, 7}), WithinAbs(1.4, 1e-12));
  CHECK_THAT(drawn_margin_px({0, 0, 8, 12.5}), WithinAbs(1.7, 1e-12));
  CHECK(drawn_margin_px({0, 0, 14, 14}) == 2.1);
  CHECK(drawn_margin_px({0, 0, 90, 70}) == 2.1);
  CHECK(drawn_margin_px({3, 4, 0, 9}) == 0);
}

TEST_CASE("Drawn boxes have their margins on all sides, and end with their picture") {
  check_box(drawn({20, 30, 8, 12.5}), {18.3, 28.3, 11.4, 15.9});
  check_box(drawn({0, 1, 8, 12.5}), {0, 0, 9.7, 15.2});
  check_box(drawn({92, 67.5, 8, 12.5}), {90.3, 65.8, 9.7, 14.2});
}

TEST_CASE("A box that reaches out of its picture is not cut") {
  check_box(drawn({-5, 70, 8, 12.5}), {-5, 68.3, 9.7, 14.2});
}

TEST_CASE("Targets fill their shares of boxes as a set has them") {
  const DrawnFills fills = {.people = {0.5, 0.8}, .animals = {0.25, 0.4}, .vehicles = {1, 0.5}};
  const auto drawn_as = [&fills](const std::string& category, const LabelBox& box) {
    LabelSet set = set_of(box, category);
    widen_as_drawn(set, fills);
    CHECK(set.labels[0].area_px == 30);
    return set.labels[0].box;
  };
  // The target is 0.6 px narrower than its visible box: 8 px are half of 16, 12 px are 0.8 of 15.
  check_box(drawn_as("human", {20, 30, 8.6, 12.6}), {16.3, 28.8, 16, 15});
  check_box(drawn_as("Human", {20, 30, 8.6, 12.6}), {16.3, 28.8, 16, 15});
  check_box(drawn_as("zebra", {40, 30, 8.6, 12.6}), {28.3, 21.3, 32, 30});
  // A box is not drawn within the visible one, and ends with its picture.
  check_box(drawn_as("truck", {20, 30, 8.6, 12.6}), {20, 24.3, 8.6, 24});
  check_box(drawn_as("human", {1, 30, 8.6, 12.6}), {0, 28.8, 13.3, 15});
}

TEST_CASE("Sets whose boxes are known by name") {
  const auto birdsai = drawn_fills_named("birdsai");
  REQUIRE(birdsai);
  CHECK(birdsai->of(Kind::human) == BoxFill{0.59, 0.6});
  CHECK(birdsai->of(Kind::animal) == BoxFill{0.54, 0.44});
  CHECK(drawn_fills_named("hit_uav")->of(Kind::vehicle) == drawn_fills_named("hit_uav")->people);
  CHECK_FALSE(drawn_fills_named("hituav"));
}

}  // namespace box_style_test
