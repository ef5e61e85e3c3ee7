#include "labels/box_style.h"

#include "support/catch.h"

namespace box_style_test {

using namespace thermal;

namespace {

LabelSet set_of(const LabelBox& box) {
  LabelSet set;
  set.images = {{.id = 1, .file = "a.png", .width_px = 100, .height_px = 80}};
  Label label;
  label.box = box;
  label.area_px = 30;
  set.labels = {label};
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

}  // namespace box_style_test
