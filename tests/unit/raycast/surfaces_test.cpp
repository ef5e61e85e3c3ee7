#include <cmath>
#include <cstdint>

#include "support/catch.h"
#include "support/ray_comparison.h"
#include "support/traced.h"

namespace surfaces_test {

using namespace small_scene;
using thermal::Passes;

namespace {

/// Looks along x from the origin, with z up.
Clip eastwards() { return {.camera_to_world = {looking({0, 0, 0}, {1, 0, 0})}, .poses = {}}; }

/// A wall across the view at a depth, towards the camera, 100 times as large as that.
shapes::Shape wall(double depth_m, std::uint16_t material) {
  const auto x = static_cast<float>(depth_m);
  const float half = 50 * x;
  return shapes::of({{x, -half, -half}, {x, half, -half}, {x, half, half}, {x, -half, half}},
                    {{0, 2, 1}, {0, 3, 2}}, material);
}

void check_right(const Scenery& place, Clip& clip, const CameraIntrinsics& camera) {
  const ray_truth::Comparison found = ray_truth::compare(place, clip, 0, camera, traced(place, clip, camera));
  INFO(found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
}

}  // namespace

TEST_CASE("Where nothing is, there is the sky") {
  Scenery place;
  place.surface(kGround, wall(-5, 1));  // behind
  Clip clip = eastwards();
  const CameraIntrinsics camera = pinhole(10, 7, 9);
  const Passes passes = traced(place, clip, camera);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      CHECK(ray_truth::is_sky(passes, x, y));
      CHECK(passes.actor_index.at(x, y) == 0);
    }
  }
}

TEST_CASE("An empty place is sky") {
  const Scenery nothing;
  Clip clip = eastwards();
  const Passes passes = traced(nothing, clip, pinhole(3, 3, 2));
  CHECK(ray_truth::is_sky(passes, 1, 1));
  Scenery bare;  // pieces without triangles
  bare.surface(kGround, {});
  bare.plant(kTree, {}, upright(5, 0, 0));
  bare.actor({{}});
  bare.actor({});
  clip.poses = {{{posed(5, 0, 0)}}, {{}}};
  CHECK(same_planes(traced(bare, clip, pinhole(3, 3, 2)), passes));
  bare.surface(kWater, wall(5, 3));  // they hide nothing
  CHECK(traced(bare, clip, pinhole(3, 3, 2)).object_index.at(1, 1) == kWater);
}

TEST_CASE("Surfaces are seen from 0.1 m to 20 km along the camera's axis") {
  const CameraIntrinsics camera = pinhole(16, 12, 8);  // corners are 50 deg off the axis
  // Positions are rounded to 1e-3 m at 20 km, and rays to 1e-7 of their length.
  for (const auto& [depth_m, seen] : {std::pair(0.0999, false), std::pair(0.1001, true),
                                      std::pair(19999.9, true), std::pair(20000.1, false)}) {
    Scenery place;
    place.surface(kGround, wall(depth_m, 1));
    Clip clip = eastwards();
    const Passes passes = traced(place, clip, camera);
    INFO("at " << depth_m << " m");
    for (const std::uint16_t object : passes.object_index.pixels()) CHECK(object == (seen ? kGround : 0));
    for (const float depth : passes.depth_m.pixels())
      CHECK(depth == (seen ? static_cast<float>(depth_m) : 1e10F));
  }
}

TEST_CASE("A surface too close to be seen hides nothing") {
  Scenery place;
  place.surface(kGround, wall(0.09, 1));
  place.surface(kWater, wall(7, 2));
  Clip clip = eastwards();
  const Passes passes = traced(place, clip, pinhole(5, 5, 3));
  for (const std::uint16_t object : passes.object_index.pixels()) CHECK(object == kWater);
}

TEST_CASE(
    "Flat normals are those of triangles, smooth ones lie between those of points, both towards the camera") {
  for (const bool smooth : {false, true}) {
    for (const bool inside : {false, true}) {
      Scenery place;
      place.surface(kGround, shapes::numbered(shapes::ball(2, 6, 1), 1));
      place.meshes[0].smooth = smooth;
      const Axis from_m = inside ? Axis{0.3, -0.2, 0.1} : Axis{6, 3, 2};
      Clip clip = {.camera_to_world = {looking(from_m, {0, 0, 0})}, .poses = {}};
      INFO("smooth " << smooth << ", inside " << inside);
      check_right(place, clip, pinhole(40, 30, 32));
    }
  }
}

TEST_CASE("A smooth normal turns with its triangle, although it may then face away") {
  // A fold of 150 deg, seen along one of its leaves from just above: normals at the fold lean away from the camera.
  Scenery place;
  const double lean_rad = 0.26;
  const auto far_z = static_cast<float>(-std::sin(lean_rad));
  const auto far_x = static_cast<float>(1 + std::cos(lean_rad));
  place.surface(kGround, shapes::smoothed(shapes::of(
                             {{0, -2, 0}, {0, 2, 0}, {1, -2, 0}, {1, 2, 0}, {far_x, 0, -3 + far_z}},
                             {{0, 2, 3}, {0, 3, 1}, {2, 4, 3}}, 1)));
  Clip clip = {.camera_to_world = {looking({-3, 0.1, 0.3}, {1, 0, 0})}, .poses = {}};
  const CameraIntrinsics camera = pinhole(30, 20, 120);
  check_right(place, clip, camera);
  const Passes passes = traced(place, clip, camera);
  int away = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      away += passes.normal[0].at(x, y) > 0.05F ? 1 : 0;  // the camera looks along x
    }
  }
  CHECK(away > 10);
}

TEST_CASE("Only the planes that are needed are filled, in memory that may hold another frame") {
  Scenery place;
  place.surface(kGround, wall(5, 4));
  Clip clip = eastwards();
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  const thermal::ClipTracer large(caster, track, pinhole(9, 9, 5));
  const thermal::ClipTracer tracer(caster, track, pinhole(6, 5, 5));
  Passes passes;
  large.trace(0, kAllPlanes, passes);
  passes.ranks.resize(1);
  tracer.trace(0, {}, passes);
  CHECK(passes.object_index == thermal::Plane<std::uint16_t>(6, 5, kGround));
  CHECK(passes.material_index == thermal::Plane<std::uint16_t>(6, 5, 4));
  CHECK((passes.depth_m.empty() && passes.actor_index.empty() && passes.normal[2].empty() &&
         passes.ranks.empty()));
  tracer.trace(0, {.depth = true}, passes);
  CHECK(passes.depth_m == thermal::Plane<float>(6, 5, 5));
  CHECK(passes.normal[0].empty());
  tracer.trace(0, {.normals = true}, passes);
  CHECK(passes.normal[0] == thermal::Plane<float>(6, 5, -1));
  CHECK(passes.depth_m.empty());
  tracer.trace(0, {.actors = true}, passes);
  CHECK(passes.actor_index == thermal::Plane<std::uint16_t>(6, 5, 0));
  thermal::ClipTracer(caster, track, pinhole(7, 5, 5)).trace(0, {}, passes);
  CHECK(passes.object_index == thermal::Plane<std::uint16_t>(7, 5, kGround));
  thermal::ClipTracer(caster, track, pinhole(7, 4, 5)).trace(0, {}, passes);
  CHECK(passes.object_index == thermal::Plane<std::uint16_t>(7, 4, kGround));
}

}  // namespace surfaces_test
