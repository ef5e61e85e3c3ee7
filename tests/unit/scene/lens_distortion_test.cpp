#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/camera_model.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace lens_distortion_test {

using namespace thermal;

namespace {

constexpr LensDistortion kLens = {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.0005};

/// From a good lens to a bad one, barrel, pincushion and moustache.
const std::vector<LensDistortion> kLenses = {kLens,
                                             {.k1 = -0.05},
                                             {.k1 = -0.35, .k2 = 0.15, .p1 = -0.002, .p2 = 0.003},
                                             {.k1 = 0.3, .k2 = -0.1, .p1 = 0.002, .p2 = 0.001},
                                             {.k1 = -0.4, .k2 = 0.6},
                                             {.k1 = -0.3, .k2 = 0.1, .p1 = 0.001, .p2 = -0.002, .k3 = 0.2}};

/// One row whose last pixel's centre is at x = 1.
CameraIntrinsics one_row() {
  return {.width_px = 201, .height_px = 1, .fx_px = 100, .fy_px = 100, .cx_px = 100.5, .cy_px = 0.5};
}

/// How far beyond the picture the lens's source is for any of its pixels; 0 if inside.
double furthest_beyond_px(const CameraIntrinsics& camera, const LensDistortion& lens) {
  double most_px = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const LensPoint seen =
          undistort(lens, {(x + 0.5 - camera.cx_px) / camera.fx_px, (y + 0.5 - camera.cy_px) / camera.fy_px});
      const double u_px = camera.cx_px + camera.fx_px * seen.x;
      const double v_px = camera.cy_px + camera.fy_px * seen.y;
      most_px = std::max(
          {most_px, 0.5 - u_px, u_px + 0.5 - camera.width_px, 0.5 - v_px, v_px + 0.5 - camera.height_px});
    }
  }
  return most_px;
}

std::string fault_of(const CameraIntrinsics& camera, const LensDistortion& lens) {
  return message_of<ConfigError>([&] { (void)overscan_px(camera, lens); });
}

}  // namespace

TEST_CASE("Points go where OpenCV's formula puts them") {
  // x = 0.5, y = -0.25: r^2 = 0.3125, radial factor 1 - 0.2 * 0.3125 + 0.03 * 0.09765625 = 0.9404296875;
  // x' = 0.47021484375 + 2 * 0.001 * -0.125 - 0.0005 * (0.3125 + 0.5),
  // y' = -0.235107421875 + 0.001 * (0.3125 + 0.125) + 2 * -0.0005 * -0.125. A dozen roundings of 1.1e-16.
  const LensPoint shown = distort(kLens, {0.5, -0.25});
  CHECK_THAT(shown.x, WithinAbs(0.46955859375, 2e-15));
  CHECK_THAT(shown.y, WithinAbs(-0.234544921875, 2e-15));
}

TEST_CASE("k3 goes with the sixth power") {
  // r^2 = 0.3125, r^6 = 0.030517578125; times 0.5 and 0.25, all of it exact.
  const LensPoint shown = distort({.k3 = 2}, {0.5, -0.25});
  CHECK(shown.x == 0.530517578125);
  CHECK(shown.y == -0.2652587890625);
  CHECK_FALSE(LensDistortion{.k3 = 1e-9}.is_none());
}

TEST_CASE("Without k3 the bits are those of the formula without it") {
  for (double x = -0.6; x < 0.61; x += 0.0371) {
    const double y = 0.3 - x / 3;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (kLens.k1 + r2 * kLens.k2);
    const LensPoint shown = distort(kLens, {x, y});
    CHECK(shown.x == x * radial + 2 * kLens.p1 * x * y + kLens.p2 * (r2 + 2 * x * x));
    CHECK(shown.y == y * radial + kLens.p1 * (r2 + 2 * y * y) + 2 * kLens.p2 * x * y);
  }
}

TEST_CASE("A camera shows directions at places, and places are of directions") {
  const CameraIntrinsics camera = {
      .width_px = 640, .height_px = 512, .fx_px = 800, .fy_px = 1000, .cx_px = 300, .cy_px = 260};
  const PicturePoint place = project(camera, {}, {0.25, -0.125});
  CHECK(place.u_px == 500);
  CHECK(place.v_px == 135);
  const LensPoint direction = unproject(camera, {}, {500, 135});
  CHECK(direction.x == 0.25);
  CHECK(direction.y == -0.125);
  const LensPoint shown = distort(kLens, {0.25, -0.125});
  CHECK(project(camera, kLens, {0.25, -0.125}).u_px == 800 * shown.x + 300);
  CHECK(project(camera, kLens, {0.25, -0.125}).v_px == 1000 * shown.y + 260);
}

TEST_CASE("A lens without distortion is a pinhole") {
  const LensPoint shown = distort({}, {0.4, -0.3});
  CHECK(shown.x == 0.4);
  CHECK(shown.y == -0.3);
  CHECK(LensDistortion().is_none());
  CHECK_FALSE(LensDistortion{.p2 = 1e-9}.is_none());
  CHECK(overscan_px(one_row(), {}) == 0);
}

TEST_CASE("Undistorting is the inverse of distorting") {
  // The header's bound. Fields of view of 62 x 52 deg end at 0.60 and 0.49.
  for (const LensDistortion& lens : kLenses) {
    for (double x = -0.6; x < 0.61; x += 0.05) {
      for (double y = -0.5; y < 0.51; y += 0.05) {
        const LensPoint back = undistort(lens, distort(lens, {x, y}));
        CHECK_THAT(back.x, WithinAbs(x, 1e-12));
        CHECK_THAT(back.y, WithinAbs(y, 1e-12));
      }
    }
  }
}

TEST_CASE("Beyond the edge of a lens's image there is no solution") {
  // r (1 - r^2) is at most 2 / (3 sqrt 3) = 0.3849.
  const LensPoint seen = undistort({.k1 = -1}, {0.39, 0});
  CHECK(std::isnan(seen.x));
  CHECK(std::isnan(seen.y));
  CHECK_FALSE(std::isnan(undistort({.k1 = -1}, {0.38, 0}).x));
}

TEST_CASE("Overscan is what a barrel shows beyond the pinhole's picture") {
  // 1.25 (1 + k1 1.25^2) = 1 for k1 = -0.128: the last pixel shows what is 25 px beyond it.
  CHECK(overscan_px(one_row(), {.k1 = -0.128}) == 25);
  CHECK(overscan_px(one_row(), {.k1 = -0.1281}) == 26);
  CHECK(overscan_px(one_row(), {.k1 = 0.390625}) == 0);  // a pincushion shows less than the pinhole
}

TEST_CASE("Every pixel finds its source within the overscan, and all of it is used") {
  // An off-centre axis, so that each side in turn is decisive. For the moustache that is the middle of a side and not
  // its ends.
  for (const auto& [cx_px, cy_px] : {std::pair(50, 72), {94, 72}, {72, 50}, {72, 94}}) {
    const CameraIntrinsics camera = {.width_px = 144,
                                     .height_px = 144,
                                     .fx_px = 160,
                                     .fy_px = 161,
                                     .cx_px = static_cast<double>(cx_px),
                                     .cy_px = static_cast<double>(cy_px)};
    for (const LensDistortion& lens : kLenses) {
      const double most_px = furthest_beyond_px(camera, lens);
      const int overscan = overscan_px(camera, lens);
      CHECK(most_px <= overscan + 1e-6);
      CHECK(most_px > overscan - 1);
    }
  }
}

TEST_CASE("A lens that folds the picture over is an error, early") {
  CHECK(fault_of(one_row(), {.k1 = -1}) ==
        "camera.distortion = k1 -1, k2 0, p1 0, p2 0, k3 0; expected a distortion that is one to one as far "
        "as the "
        "corners of the picture");
  // Falls from r = 0.60 to 0.83 and rises again: the border, at 1 and more, has a source, but the points before it
  // appear three times.
  const CameraIntrinsics square = {
      .width_px = 201, .height_px = 201, .fx_px = 100, .fy_px = 100, .cx_px = 100.5, .cy_px = 100.5};
  CHECK(fault_of(square, {.k1 = -1.4, .k2 = 0.8}) ==
        "camera.distortion = k1 -1.4, k2 0.8, p1 0, p2 0, k3 0; expected a distortion that is one to one as "
        "far as "
        "the "
        "corners of the picture");
}

TEST_CASE("A lens that needs more overscan than the limit is an error") {
  // 1.42 (1 + k1 1.42^2) = 1 for k1 = -0.1466846: 4200 px beyond the picture of a camera with 10,000 px a unit.
  const CameraIntrinsics camera = {
      .width_px = 20001, .height_px = 1, .fx_px = 10000, .fy_px = 10000, .cx_px = 10000.5, .cy_px = 0.5};
  CHECK(fault_of(camera, {.k1 = -0.1466846}) ==
        "camera.distortion = k1 -0.1466846, k2 0, p1 0, p2 0, k3 0; expected a distortion that reaches at "
        "most 4096 "
        "px "
        "beyond the picture, not 4200 px");
}

}  // namespace lens_distortion_test
