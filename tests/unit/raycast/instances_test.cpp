#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.h"
#include "support/ray_comparison.h"
#include "support/traced.h"

namespace instances_test {

using namespace small_scene;
using thermal::Passes;

namespace {

/// A body without symmetry: a smooth or flat ball, dented by a bump.
shapes::Shape body(bool smooth, double size) {
  shapes::Shape shape = shapes::numbered(shapes::ball(size, 5, 1), 1);
  for (shapes::Point& point : shape.points_m) {
    point[0] *= point[1] > 0 ? 1.4F : 0.8F;
    point[2] += 0.3F * point[0];
  }
  shape.smooth = smooth;
  return shape;
}

/// A bone of this mesh, seen from 6 m away, against the truth.
void check_bone(const shapes::Shape& shape, const Matrix& to_world) {
  Scenery place;
  place.actor({shape});
  const Axis middle_m = {to_world[3], to_world[7], to_world[11]};
  for (const Axis& aside_m : {Axis{5, 3, 2}, Axis{-4, 4, -3}}) {
    const Axis from_m = {middle_m[0] + aside_m[0], middle_m[1] + aside_m[1], middle_m[2] + aside_m[2]};
    Clip clip = {.camera_to_world = {looking(from_m, middle_m)}, .poses = {{{to_world}}}};
    const CameraIntrinsics camera = pinhole(40, 32, 60);
    const ray_truth::Comparison found =
        ray_truth::compare(place, clip, 0, camera, traced(place, clip, camera));
    INFO(found.wrong << " pixels are wrong\n" << found.faults);
    CHECK(found.wrong == 0);
    CHECK(found.actors > 100);
    CHECK(found.sky > 100);
  }
}

}  // namespace

TEST_CASE("Bones that are stretched, mirrored or sheared have the right outlines and normals") {
  const std::vector<Matrix> transforms = {posed(1, 2, 3, 0.7, {1, 1, 1}),
                                          posed(1, 2, 3, 0.7, {0.5, 1.3, 1}),
                                          posed(-3, 0, 1, 2, {-1, 1, 1}),
                                          posed(0, 0, 0, 1, {0.7, -1.2, 1.1}),
                                          posed(0, 0, 0, 5, {1, 1, -0.8}),
                                          posed(2, 2, 2, 3, {-1, -0.9, -1.1}),
                                          {1, 0.4, 0, 3, 0, 0.8, -0.3, 4, 0.2, 0, 1.1, 5},
                                          {0, 1, 0.2, 0, 1, 0, 0, 0, 0, 0.3, 1, 0}};
  for (const Matrix& to_world : transforms) {
    for (const bool smooth : {false, true}) {
      INFO("smooth " << smooth);
      check_bone(body(smooth, 1), to_world);
    }
  }
}

TEST_CASE("Meshes of 10 km that are scaled by 1e-4, and of 0.1 mm by 1e4, look like those of 1 m") {
  for (const bool smooth : {false, true}) {
    check_bone(body(smooth, 1e4), posed(4, -3, 1, 0.4, {1e-4, 1.2e-4, 1e-4}));
    check_bone(body(smooth, 1e-4), posed(4, -3, 1, 0.4, {1e4, 0.9e4, -1e4}));
  }
}

TEST_CASE("Plants of 0.1 mm and of 10 km are seen") {
  Scenery place;
  place.plant(kTree, body(false, 1), upright(2.2, 0.1, 0.1, 1, 1e-4));
  place.plant(kShrub, body(true, 1), upright(9000, 4000, -3000, 2, 1e4));
  Clip clip = {.camera_to_world = {looking({2, 0, 0}, {2.2, 0.1, 0.1})}, .poses = {}};
  // 0.1 mm at 0.24 m is 8 px wide. The place is rounded by 2e-7 m, which is 1e-6 of the distance.
  const CameraIntrinsics camera = pinhole(30, 24, 10000);
  const Passes passes = traced(place, clip, camera);
  const ray_truth::Comparison found = ray_truth::compare(place, clip, 0, camera, passes);
  INFO(found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
  CHECK(std::ranges::count(passes.object_index.pixels(), kTree) > 40);
  clip.camera_to_world[0] = looking({-9000, 0, 0}, {9000, 4000, -3000});
  const ray_truth::Comparison wide =
      ray_truth::compare(place, clip, 0, pinhole(40, 32, 20), traced(place, clip, pinhole(40, 32, 20)));
  INFO(wide.wrong << " pixels are wrong\n" << wide.faults);
  CHECK(wide.wrong == 0);
  CHECK(wide.sky < 40 * 32 - 200);
}

TEST_CASE("Plants of one species may be of several meshes") {
  Scenery place;
  const auto box = static_cast<std::uint32_t>(place.mesh(shapes::cube(1, 1)));
  const auto ball = static_cast<std::uint32_t>(place.mesh(shapes::ball(0.5, 4, 2)));
  place.plants = {{.object = kTree, .transform = {}, .mesh = {}}};
  for (std::uint32_t k = 0; k < 24; ++k) {
    place.plants[0].transform.push_back(upright(1.7 * (k % 6), 1.7 * (k / 6), 0.1 * k, k, 0.5 + 0.03 * k));
    place.plants[0].mesh.push_back(k % 3 == 0 ? ball : box);
  }
  Clip clip = {.camera_to_world = {looking({4, -5, 9}, {4, 2, 0})}, .poses = {}};
  const CameraIntrinsics camera = pinhole(60, 40, 50);
  const ray_truth::Comparison found = ray_truth::compare(place, clip, 0, camera, traced(place, clip, camera));
  INFO(found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
  CHECK(found.sky < 40 * 60 - 400);
}

TEST_CASE("Of a million plants, each pixel shows the right one") {
  // Cubes of 0.5 m on a grid of 1 m, seen straight down from 20 m above their tops, where 1 m is 20 px. On two cores:
  // 1.5 s and 500 MB to build, 0.04 s for the frame.
  constexpr int kSide = 1000;
  Scenery place;
  const auto cube = static_cast<std::uint32_t>(place.mesh(shapes::cube(0.5, 1)));
  place.plants.resize(2);
  for (int k = 0; k < kSide * kSide; ++k) {
    Scenery::Plants& plants = place.plants.at(static_cast<std::size_t>(k % 2));
    plants.object = static_cast<std::uint16_t>(kTree + k % 2);
    plants.transform.push_back(upright(k % kSide, k / kSide, -0.25));
    plants.mesh.push_back(cube);
  }
  Clip clip = {.camera_to_world = {looking_down(500.25, 499.75, 20)}, .poses = {}};
  CameraIntrinsics camera = pinhole(640, 512, 400);
  const Passes passes = traced(place, clip, camera);
  long wrong = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const double east_m = 500.25 + (x + 0.5 - camera.cx_px) / 20;
      const double north_m = 499.75 - (y + 0.5 - camera.cy_px) / 20;
      const double column = std::round(east_m);
      const bool on_top = std::abs(east_m - column) < 0.25 && std::abs(north_m - std::round(north_m)) < 0.25;
      if (!on_top) continue;
      wrong += passes.object_index.at(x, y) == kTree + static_cast<int>(column) % 2 ? 0 : 1;
      wrong += passes.depth_m.at(x, y) == 20 ? 0 : 1;
    }
  }
  CHECK(wrong == 0);
}

}  // namespace instances_test
