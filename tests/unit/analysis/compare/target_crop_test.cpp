#include "analysis/target_crop.h"

#include "support/catch.h"
#include "support/grey_frames.h"

namespace target_crop_test {

using namespace thermal;
using grey_frames::frame_of;

namespace {

/// 10 x 14 px at 150, from (30, 20) on, on ground at 50; what `more` says is warm too.
Plane<float> warm_block(const std::function<bool(int, int)>& more = [](int, int) { return false; }) {
  return frame_of(80, 60, [&more](int x, int y) {
    const bool inside = x >= 30 && x < 40 && y >= 20 && y < 34;
    return inside || more(x, y) ? 150 : 50;
  });
}

}  // namespace

TEST_CASE("A warm block in a box that is too large") {
  const auto crop = target_crop(warm_block(), {28, 19, 15, 19});
  REQUIRE(crop);
  CHECK_THAT(crop->contrast, WithinRel(100.0, 1e-12));
  CHECK(crop->ring_deviation == 0);
  // 140 of 285 px are warm.
  CHECK_THAT(crop->entropy_bits, WithinRel(0.9997780, 1e-6));
  REQUIRE(crop->margins);
  CHECK(crop->margins->left_px == 2);
  CHECK(crop->margins->right_px == 3);
  CHECK(crop->margins->top_px == 1);
  CHECK(crop->margins->bottom_px == 4);
  CHECK(crop->margins->blob_width_px == 10);
  CHECK(crop->margins->blob_height_px == 14);
}

TEST_CASE("A box that is too small has negative margins") {
  const auto crop = target_crop(warm_block(), {31.5, 20, 8, 12.5});
  REQUIRE(crop);
  REQUIRE(crop->margins);
  CHECK(crop->margins->left_px == -1.5);
  CHECK(crop->margins->right_px == -0.5);
  CHECK(crop->margins->top_px == 0);
  CHECK(crop->margins->bottom_px == -1.5);
}

TEST_CASE("A blob that goes on beyond the ring has no margins") {
  const auto crop =
      target_crop(warm_block([](int x, int y) { return x >= 30 && x < 70 && y == 25; }), {30, 20, 10, 14});
  REQUIRE(crop);
  CHECK_FALSE(crop->margins);
}

TEST_CASE("Another warm thing in the ring is not the target's") {
  const auto crop = target_crop(
      warm_block([](int x, int y) { return x >= 43 && x < 45 && y > 24 && y < 28; }), {30, 20, 10, 14});
  REQUIRE(crop);
  REQUIRE(crop->margins);
  CHECK(crop->margins->right_px == 0);
}

TEST_CASE("The ring's texture is its deviation, and hides targets without contrast") {
  const auto stripes = frame_of(80, 60, [](int x, int y) {
    return x >= 30 && x < 40 && y >= 20 && y < 34 ? 90 : x % 2 == 0 ? 40 : 60;
  });
  const auto crop = target_crop(stripes, {30, 20, 10, 14});
  REQUIRE(crop);
  CHECK_THAT(crop->contrast, WithinRel(40.0, 1e-12));
  CHECK_THAT(crop->ring_deviation, WithinRel(10.0, 0.002));  // n - 1 of 432 px
  CHECK(crop->margins);                                      // four deviations of the ring
  const auto weak =
      target_crop(frame_of(80, 60, [](int x, int) { return x % 2 == 0 ? 40 : 60; }), {30, 20, 10, 14});
  REQUIRE(weak);
  CHECK_FALSE(weak->margins);
}

TEST_CASE("Pixels that are white, or nearly, are counted within the box") {
  const auto crop = target_crop(frame_of(80, 60,
                                         [](int x, int y) {
                                           if (x < 30 || x >= 40 || y < 20 || y >= 34) return 255;
                                           return x == 31 ? 255 : y == 22 ? 252 : 251;
                                         }),
                                {30, 20, 10, 14});
  CHECK(crop.value().white_share == 23.0 / 140);  // a column, a row, and the pixel of both once
}

TEST_CASE("Gradients within a slope are equal, at the border of a block they are not") {
  CHECK(
      target_crop(frame_of(80, 60, [](int x, int) { return 2 * x; }), {30, 20, 10, 14})->gradient_variance ==
      0);
  // Of rows across a border: gradients of 50 in two of ten columns. Mean 10, variance 400 x 140 / 139.
  const auto border = frame_of(80, 60, [](int x, int) { return x < 35 ? 50 : 150; });
  CHECK_THAT(target_crop(border, {30, 20, 10, 14})->gradient_variance, WithinRel(400.0 * 140 / 139, 1e-12));
}

TEST_CASE("Boxes that are too small, outside, or the whole frame are no targets") {
  CHECK_FALSE(target_crop(warm_block(), {30, 20, 2, 14}));
  CHECK_FALSE(target_crop(warm_block(), {200, 20, 10, 14}));
  CHECK_FALSE(target_crop(warm_block(), {-20, 20, 10, 14}));
  CHECK_FALSE(target_crop(warm_block(), {0, 0, 80, 60}));
  CHECK(target_crop(warm_block(), {-4, -4, 10, 14}));
}

}  // namespace target_crop_test
