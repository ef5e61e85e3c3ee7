#include <cmath>
#include <numbers>

#include "imaging/actor_labeller.h"
#include "support/catch.h"

namespace actor_box_test {

using namespace thermal;

namespace {

/// 100 x 80 px; a tangent of 1 is 100 px.
const CameraIntrinsics kCamera = {
    .width_px = 100, .height_px = 80, .fx_px = 100, .fy_px = 100, .cx_px = 50, .cy_px = 40};

/// 20 m up at (5, 7), looking straight down: right is +x, down in the picture is -y.
const std::array<double, 16> kDown = {1, 0, 0, 5, 0, -1, 0, 7, 0, 0, -1, 20, 0, 0, 0, 1};

/// 2 m long, 1.5 m wide and 4 m high, more of it in front and to the left than behind and to the right.
ManifestObject animal() {
  ManifestObject actor;
  actor.bounds_m = {{{-0.5, -0.5, 0}, {1.5, 1, 4}}};
  return actor;
}

SeenBox seen(const ActorPose& pose, const LensDistortion& lens = {},
             const std::array<double, 16>& camera_to_world = kDown) {
  return see_box(kCamera, lens, animal(), pose, camera_to_world).value();
}

void check_box(const std::optional<LabelBox>& box, const LabelBox& expected) {
  REQUIRE(box);
  CHECK_THAT(box->x_px, WithinAbs(expected.x_px, 1e-9));
  CHECK_THAT(box->y_px, WithinAbs(expected.y_px, 1e-9));
  CHECK_THAT(box->width_px, WithinAbs(expected.width_px, 1e-9));
  CHECK_THAT(box->height_px, WithinAbs(expected.height_px, 1e-9));
}

}  // namespace

TEST_CASE("A box below the camera is projected by its nearest face, and its centre has the right distance") {
  const SeenBox box = seen({.position_m = {5, 7, 0}, .heading_rad = 0});
  // The top is 16 m away: -0.5 m to 1.5 m at 100 / 16 px per metre.
  check_box(box.box_px, {.x_px = 50 - 3.125, .y_px = 40 - 6.25, .width_px = 12.5, .height_px = 9.375});
  CHECK_THAT(box.range_m, WithinAbs(std::hypot(0.5, 0.25, 18), 1e-12));
}

TEST_CASE("It turns with the actor") {
  const SeenBox box = seen({.position_m = {5, 7, 0}, .heading_rad = std::numbers::pi / 2});  // towards +y: up
  check_box(box.box_px, {.x_px = 50 - 6.25, .y_px = 40 - 9.375, .width_px = 9.375, .height_px = 12.5});
}

TEST_CASE("It may be outside the picture") {
  const SeenBox box = seen({.position_m = {25, 7, 0}, .heading_rad = 0});
  // From 19.5 m at a depth of 20 m to 21.5 m at 16 m.
  CHECK_THAT(box.box_px->x_px, WithinAbs(50 + 97.5, 1e-9));
  CHECK_THAT(box.box_px->x_px + box.box_px->width_px, WithinAbs(50 + 134.375, 1e-9));
}

TEST_CASE("Parts beside and behind the camera are clipped in front of it") {
  // Level with the camera's plane, from 0.5 m behind to 1.5 m in front of it: looking along +x, right is -y.
  const std::array<double, 16> along = {0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1};
  const SeenBox box = seen({.position_m = {0, 0, 0}, .heading_rad = 0}, {}, along);
  // At 0.05 m, a metre to the left, half of one to the right, 2 m up and down.
  check_box(box.box_px, {.x_px = 50 - 2000, .y_px = 40 - 4000, .width_px = 3000, .height_px = 8000});
  CHECK_THAT(box.range_m, WithinAbs(std::hypot(0.5, 0.25), 1e-12));
  const SeenBox behind = seen({.position_m = {-10, 0, 0}, .heading_rad = 0}, {}, along);
  CHECK_FALSE(behind.box_px);
  CHECK_THAT(behind.range_m, WithinAbs(std::hypot(9.5, 0.25), 1e-12));
}

TEST_CASE("Without bounds there is no box") {
  CHECK_FALSE(see_box(kCamera, {}, ManifestObject(), ActorPose(), kDown));
}

TEST_CASE("A lens moves corners like other points") {
  const LensDistortion lens = {.k1 = -0.2, .k2 = 0.03, .p1 = 0.01, .p2 = -0.005};
  const SeenBox box = seen({.position_m = {7, 6, 0}, .heading_rad = 0}, lens);
  double left = 1e9;
  double right = -1e9;
  for (const double x_m : {1.5, 3.5}) {
    for (const double y_m : {0.0, 1.5}) {
      for (const double depth_m : {16.0, 20.0}) {
        const double u_px = 50 + 100 * distort(lens, {x_m / depth_m, y_m / depth_m}).x;
        left = std::min(left, u_px);
        right = std::max(right, u_px);
      }
    }
  }
  CHECK_THAT(box.box_px->x_px, WithinAbs(left, 1e-9));
  CHECK_THAT(box.box_px->x_px + box.box_px->width_px, WithinAbs(right, 1e-9));
}

TEST_CASE("Beyond the fold of a lens, far points stay far out") {
  // r (1 - 0.4 r^2) is largest at r = sqrt(1 / 1.2) = 0.913, and 0.6086 there: 60.86 px from the axis. A step is a
  // 96th of three times the corner's 0.64, or of the way: 0.02, over which the top of 1.2 r (0.02)^2 is flat within
  // 0.05 px.
  const LensDistortion lens = {.k1 = -0.4};
  for (const double away_m : {25.0, 40.0, 400.0, 4e6}) {
    CAPTURE(away_m);
    const SeenBox box = seen({.position_m = {5 + away_m, 7, 0}, .heading_rad = 0}, lens);
    CHECK_THAT(box.box_px->x_px + box.box_px->width_px, WithinAbs(50 + 60.86, 0.05));
    CHECK(std::isfinite(box.box_px->x_px));
  }
}

}  // namespace actor_box_test
