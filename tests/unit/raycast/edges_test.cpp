#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/catch.h"
#include "support/grove.h"
#include "support/ray_comparison.h"
#include "support/traced.h"

namespace edges_test {

using namespace small_scene;
using thermal::Passes;

namespace {

ray_truth::Comparison check_right(const Scenery& place, Clip& clip, const CameraIntrinsics& camera) {
  const ray_truth::Comparison found = ray_truth::compare(place, clip, 0, camera, traced(place, clip, camera));
  INFO(found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
  return found;
}

/// Cameras that look from one place at every corner of a mesh, every middle of a side and a point of every side near
/// its end.
std::vector<std::array<double, 16>> at_edges(const shapes::Shape& shape, const Matrix& to_world,
                                             const Axis& from_m) {
  std::vector<std::array<double, 16>> poses;
  for (const shapes::Corners& corners : shape.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const shapes::Point& a = shape.points_m[corners.at(k)];
      const shapes::Point& b = shape.points_m[corners.at((k + 1) % 3)];
      for (const double share : {0.0, 1e-6, 0.5}) {
        Axis point_m{};
        for (std::size_t row = 0; row < 3; ++row) {
          point_m.at(row) = to_world.at(4 * row + 3);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            point_m.at(row) += to_world.at(4 * row + axis) * ((1 - share) * static_cast<double>(a.at(axis)) +
                                                              share * static_cast<double>(b.at(axis)));
          }
        }
        poses.push_back(looking(from_m, point_m, {0.1, 0.2, 1}));
      }
    }
  }
  return poses;
}

/// How many of the rays at corners and sides of a closed mesh around the camera see something else.
long slips(const shapes::Shape& shape, const Matrix& to_world, const Axis& from_m) {
  Scenery place;
  place.plant(kTree, shape, to_world);
  place.surface(kWater, shapes::cube(9000, 1));  // around it
  Clip clip = {.camera_to_world = at_edges(shape, to_world, from_m), .poses = {}};
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  const thermal::ClipTracer tracer(caster, track, pinhole(1, 1, 1));
  long count = 0;
  Passes passes;
  for (std::size_t frame = 0; frame < track.frames; ++frame) {
    tracer.trace(frame, {}, passes);
    count += passes.object_index.at(0, 0) == kTree ? 0 : 1;
  }
  return count;
}

}  // namespace

TEST_CASE("No ray at a corner or a side of a closed mesh slips through") {
  const shapes::Shape ball = shapes::ball(2, 12, 1);
  CHECK(slips(ball, kIdentity, {0.1, -0.3, 0.2}) == 0);
  CHECK(slips(ball, upright(700, -300, 20, 0.7, 1.3), {700.4, -299.5, 20.2}) == 0);
  CHECK(slips(shapes::cube(3, 1), upright(0, 0, 0, 1), {0, 0, 0}) == 0);
  // Slivers: 200 times as high as wide.
  CHECK(slips(shapes::box({-.01F, -.01F, -2}, {.01F, .01F, 2}, 1), upright(5, 5, 0, 0.3, 50), {5.1, 5, 9}) ==
        0);
}

TEST_CASE("No ray at all slips out of a closed mesh") {
  Scenery place;
  place.plant(kTree, shapes::ball(4, 40, 1), upright(-40, 30, 3, 0.3));
  Clip clip = {.camera_to_world = {looking({-41, 31, 4}, {-38, 32, 5}),
                                   looking({-41, 31, 4}, {-41, 31, 0}, {1, 0, 0})},
               .poses = {}};
  for (std::size_t frame = 0; frame < 2; ++frame) {
    const Passes passes = traced(place, clip, pinhole(301, 203, 90), frame);
    CHECK(std::ranges::count(passes.object_index.pixels(), kTree) == 301 * 203);
  }
}

TEST_CASE("Ground is seen as far as the horizon") {
  Scenery place;
  place.surface(kGround, shapes::level(4000, 10, 1));
  place.actor({shapes::box({-.4F, -.3F, 0}, {.4F, .3F, 1.8F}, 2)});
  // The ground ends 0.06 deg below the horizon, of which a pixel is 0.01 deg high.
  Clip clip = {.camera_to_world = {looking({1, 2, 2}, {1000, 8, 2})}, .poses = {{{posed(700, 6, 0)}}}};
  CameraIntrinsics camera = pinhole(31, 41, 5500);
  camera.cy_px = 20.25;
  const ray_truth::Comparison found = check_right(place, clip, camera);
  CHECK(found.sky > 10 * 31);
  CHECK(found.sky < 31 * 31);
  CHECK(found.actors > 20);
  // A camera on the ground is in the plane of all of it, and sees nothing.
  clip = {.camera_to_world = {looking({1, 2, 0}, {1000, 3, 0})}, .poses = {{{}}}};
  const Passes passes = traced(place, clip, pinhole(9, 1, 20));
  CHECK(std::ranges::count(passes.object_index.pixels(), 0) == 9);
}

TEST_CASE("A camera inside a crown sees its leaves from inside, but for those too close") {
  Scenery place = grove::place();
  Clip clip = grove::clip();
  clip.camera_to_world[0] = looking({3.1, 2.2, 4.9}, {-3, -2, 1});
  CHECK(check_right(place, clip, grove::camera()).sky == 0);
  // Leaves of 2 cm, some of them nearer than 0.1 m.
  shapes::Shape leaves;
  for (int k = 0; k < 400; ++k) {
    const double turn = 2.4 * k;
    const double out_m = 0.01 * std::sqrt(k);
    shapes::Shape leaf = shapes::of({{0, 0, 0}, {.02F, .005F, 0}, {.01F, .02F, .004F}}, {{0, 1, 2}}, 1);
    for (shapes::Point& point : leaf.points_m) {
      point[0] += static_cast<float>(out_m * std::cos(turn));
      point[1] += static_cast<float>(out_m * std::sin(turn));
      point[2] += static_cast<float>(0.1 * std::sin(1.7 * k));
    }
    leaves = shapes::joined(leaves, leaf);
  }
  place.plant(kShrub, shapes::numbered(leaves, 100), upright(20, 0, 2, 1, 1.5));
  clip.camera_to_world[0] = looking({20.02, 0.01, 2}, {0, 0, 1});
  check_right(place, clip, grove::camera());
}

TEST_CASE("Triangles without an area show nothing and change no normal") {
  const shapes::Shape ball = shapes::smoothed(shapes::ball(2, 6, 1));
  shapes::Shape more = ball;
  for (std::uint32_t k = 0; k + 3 < ball.points_m.size(); k += 3) {
    more.triangles.push_back({k, k, k + 1});  // a side
    more.triangles.push_back({k + 2, k, k});
    more.triangles.push_back({k, k, k});  // a point
  }
  // Three points in line, exactly.
  const auto first = static_cast<std::uint32_t>(more.points_m.size());
  for (const float x : {-3.F, 0.5F, 3.F}) more.points_m.push_back({x, x / 2, x / 4});
  more.triangles.push_back({first, first + 1, first + 2});
  more = shapes::painted(more, 1);
  more.smooth = true;
  Clip clip = {.camera_to_world = {looking({6, 3, 2}, {0, 0, 0})}, .poses = {}};
  const CameraIntrinsics camera = pinhole(60, 45, 50);
  Scenery plain;
  plain.surface(kGround, ball);
  Scenery odd;
  odd.surface(kGround, more);
  check_right(odd, clip, camera);
  CHECK(same_planes(traced(odd, clip, camera), traced(plain, clip, camera)));
  shapes::Shape alone = more;
  alone.triangles.erase(alone.triangles.begin(), alone.triangles.begin() + std::ssize(ball.triangles));
  Scenery nothing;
  nothing.surface(kGround, alone);
  const Passes passes = traced(nothing, clip, camera);
  CHECK(std::ranges::count(passes.object_index.pixels(), 0) == 60 * 45);
}

TEST_CASE("Slivers of a hair's width have finite depths and unit normals") {
  Scenery place;
  shapes::Shape hairs;
  for (int k = 0; k < 300; ++k) {
    const float y = 0.01F * static_cast<float>(k) - 1.5F;
    hairs = shapes::joined(
        hairs, shapes::of({{0, y, -2}, {0.3F, y + 1e-5F, 2}, {0, y + 2e-3F, 2.5F}}, {{0, 1, 2}}, 1));
  }
  place.surface(kGround, hairs);
  Clip clip = {.camera_to_world = {looking({-4, 0.2, 0.3}, {0, 0, 0})}, .poses = {}};
  const CameraIntrinsics camera = pinhole(150, 40, 160);
  CHECK(check_right(place, clip, camera).sky < 150 * 40 - 500);
  const Passes passes = traced(place, clip, camera);
  for (std::size_t k = 0; k < passes.depth_m.size(); ++k) {
    if (passes.object_index.pixels()[k] == 0) continue;
    CHECK(std::isfinite(passes.depth_m.pixels()[k]));
    const float x = passes.normal[0].pixels()[k];
    const float y = passes.normal[1].pixels()[k];
    const float z = passes.normal[2].pixels()[k];
    CHECK_THAT(static_cast<double>(x * x + y * y + z * z), WithinAbs(1, 1e-6));
  }
}

}  // namespace edges_test
