#include <cmath>
#include <cstdint>
#include <string>

#include "scene/camera_geometry.h"
#include "support/catch.h"
#include "support/grove.h"
#include "support/ray_comparison.h"
#include "support/traced.h"

namespace rays_test {

using namespace small_scene;
using thermal::LensDistortion;
using thermal::Passes;

namespace {

/// The grove in a frame against the truth.
void check_grove(const CameraIntrinsics& camera, std::size_t frame, const LensDistortion& lens = {}) {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  const Passes passes = traced(place, clip, camera, frame, lens);
  const ray_truth::Comparison found = ray_truth::compare(place, clip, frame, camera, passes, lens);
  INFO("frame " << frame << ", " << found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
  // Each pixel that an outline crosses is uncertain with a probability of 4e-6 * 50 px * 2: 0.1 of the 2173.
  CHECK(found.uncertain <= 3);
  CHECK(found.actors > 10);
}

}  // namespace

TEST_CASE("Pixels of a level floor show the squares below their centres") {
  Scenery place;
  place.surface(kGround, shapes::numbered(shapes::level(64, 64, 1), 1));
  Clip clip = {.camera_to_world = {looking_down(0, 0, 16)}, .poses = {}};
  // 16 m above squares of 1 m: 0.8 squares a pixel in x, 0.5 in y. No centre lies on a line.
  const CameraIntrinsics camera = {
      .width_px = 30, .height_px = 22, .fx_px = 20, .fy_px = 32, .cx_px = 11.3125, .cy_px = 14.71875};
  const Passes passes = traced(place, clip, camera);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const double east_m = 16 * (x + 0.5 - camera.cx_px) / camera.fx_px + 32;
      const double north_m = 32 - 16 * (y + 0.5 - camera.cy_px) / camera.fy_px;
      const double column = std::floor(east_m);
      const double row = std::floor(north_m);
      const bool upper = north_m - row > east_m - column;
      CHECK(passes.material_index.at(x, y) == 1 + 2 * static_cast<int>(row * 64 + column) + (upper ? 1 : 0));
      CHECK(passes.depth_m.at(x, y) == 16);  // along the axis
    }
  }
}

TEST_CASE("A pinhole with its axis off the middle and oblong pixels sees what it should") {
  for (std::size_t frame = 0; frame < 3; ++frame) check_grove(grove::camera(), frame);
}

TEST_CASE("Finer pixels show what lies between") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  const CameraIntrinsics camera = grove::camera();
  const Passes coarse = traced(place, clip, camera);
  const Passes fine = traced(place, clip, thermal::finer(camera, 3));
  REQUIRE(fine.depth_m.width_px() == 3 * camera.width_px);
  REQUIRE(fine.depth_m.height_px() == 3 * camera.height_px);
  // Numerator and denominator of the middle ray's coordinates are three times those of the coarse ray, exactly.
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      CHECK(fine.object_index.at(3 * x + 1, 3 * y + 1) == coarse.object_index.at(x, y));
      CHECK(fine.depth_m.at(3 * x + 1, 3 * y + 1) == coarse.depth_m.at(x, y));
    }
  }
  check_grove(thermal::finer(camera, 2), 1);
}

TEST_CASE("A lens bends the rays, to either side") {
  check_grove(grove::camera(), 0, {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.0005});
  check_grove(grove::camera(), 2, {.k1 = 0.3, .k2 = -0.1, .p1 = 0.002, .p2 = 0.001, .k3 = 0.02});
}

TEST_CASE("A lens shows each pixel what the camera projects to its centre") {
  // Two walls that lean to the camera give each ray's direction: depth = 8 / (1 - 0.5 x) and 8 / (1 - 0.5 y).
  const CameraIntrinsics camera = grove::camera();
  const LensDistortion lens = {.k1 = -0.25, .k2 = 0.08, .p1 = -0.002, .p2 = 0.003, .k3 = 0.01};
  const auto wall = [](float right, float down) {
    const auto at = [=](float x, float y) { return shapes::Point{x, y, 8 + right * x + down * y}; };
    return shapes::of({at(-40, -40), at(40, -40), at(40, 40), at(-40, 40)}, {{0, 2, 1}, {0, 3, 2}}, 1);
  };
  Clip clip = {.camera_to_world = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, .poses = {}};
  Scenery leans_right;
  leans_right.surface(kGround, wall(0.5F, 0));
  Scenery leans_down;
  leans_down.surface(kGround, wall(0, 0.5F));
  const Passes right = traced(leans_right, clip, camera, 0, lens);
  const Passes down = traced(leans_down, clip, camera, 0, lens);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const thermal::PicturePoint shown =
          thermal::project(camera, lens, {2 - 16 / right.depth_m.at(x, y), 2 - 16 / down.depth_m.at(x, y)});
      // Depth is rounded by 6e-8, 2 - 16 / depth is off by 16 / 8 of that times 1.3, and 55 px by 7e-6 px.
      CHECK_THAT(shown.u_px, WithinAbs(x + 0.5, 1e-5));
      CHECK_THAT(shown.v_px, WithinAbs(y + 0.5, 1e-5));
    }
  }
}

TEST_CASE("A picture of any size shows the same as a larger one with the same axis") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  CameraIntrinsics camera = grove::camera();
  const Passes large = traced(place, clip, camera);
  for (camera.width_px = 1; camera.width_px < 10; ++camera.width_px) {
    for (camera.height_px = 1; camera.height_px < 6; ++camera.height_px) {
      const Passes small = traced(place, clip, camera);
      REQUIRE(small.object_index.width_px() == camera.width_px);
      REQUIRE(small.object_index.height_px() == camera.height_px);
      for (int y = 0; y < camera.height_px; ++y) {
        for (int x = 0; x < camera.width_px; ++x) {
          CHECK(small.object_index.at(x, y) == large.object_index.at(x, y));
          CHECK(small.actor_index.at(x, y) == large.actor_index.at(x, y));
          CHECK(small.depth_m.at(x, y) == large.depth_m.at(x, y));
          CHECK(small.normal[0].at(x, y) == large.normal[0].at(x, y));
        }
      }
    }
  }
}

TEST_CASE("The pose of the camera is rounded to single precision, as Blender has it") {
  const Scenery place = grove::place();
  Clip rounded = grove::clip();
  Clip exact = rounded;
  for (double& entry : exact.camera_to_world[0]) entry *= 1 + 1e-8;
  CHECK(same_planes(traced(place, exact, grove::camera()), traced(place, rounded, grove::camera())));
}

}  // namespace rays_test
