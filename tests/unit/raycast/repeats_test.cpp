#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "support/catch.h"
#include "support/grove.h"
#include "support/traced.h"

namespace repeats_test {

using namespace small_scene;
using thermal::Passes;

namespace {

/// A frame of a place that is built and traced by this many threads.
Passes traced_by(int threads, const Scenery& place, Clip& clip, const CameraIntrinsics& camera,
                 std::size_t frame = 0) {
  return thermal::with_threads(threads, [&] { return traced(place, clip, camera, frame); });
}

}  // namespace

TEST_CASE("Any number of threads makes the same bits") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const Passes one = traced_by(1, place, clip, grove::camera(), frame);
    CHECK(same_planes(traced_by(2, place, clip, grove::camera(), frame), one));
    CHECK(same_planes(traced_by(0, place, clip, grove::camera(), frame), one));
  }
}

TEST_CASE("Frames are the same in any order, and on several threads at once") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  const thermal::ClipTracer tracer(caster, track, grove::camera());
  std::vector<Passes> frames(3);
  for (const std::size_t frame : {0U, 1U, 2U}) tracer.trace(frame, kAllPlanes, frames[frame]);
  Passes again;
  for (const std::size_t frame : {2U, 0U, 1U, 1U, 0U}) {
    tracer.trace(frame, kAllPlanes, again);
    CHECK(same_planes(again, frames[frame]));
  }
  std::vector<Passes> many(30);
  thermal::parallel_for(many.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) tracer.trace(k % 3, kAllPlanes, many[k]);
  });
  for (std::size_t k = 0; k < many.size(); ++k) CHECK(same_planes(many[k], frames[k % 3]));
}

TEST_CASE("Of surfaces in one plane, one is seen, always the same") {
  Scenery place;
  place.surface(kGround, shapes::level(30, 9, 1));
  place.surface(kWater, shapes::level(30, 9, 2));
  place.plant(kTree, shapes::box({-3, -3, -1}, {3, 3, 0}, 3), upright(0, 0, 0, 0.5));
  place.actor({shapes::box({-2, -2, -1}, {2, 2, 0}, 4)});
  Clip clip = {.camera_to_world = {looking({-8, 3, 7}, {0, 0, 0})}, .poses = {{{posed(1, 1, 0, 1)}}}};
  const CameraIntrinsics camera = pinhole(47, 33, 40);
  const Passes first = traced_by(1, place, clip, camera);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const std::uint16_t object = first.object_index.at(x, y);
      const std::uint16_t material = first.material_index.at(x, y);
      const bool known = (object == kGround && material == 1) || (object == kWater && material == 2) ||
                         (object == kTree && material == 3) || (object == kFirstActor && material == 4);
      CHECK((known || object == 0));
      CHECK((object == 0 || first.normal[2].at(x, y) == 1));
    }
  }
  CHECK(std::ranges::count(first.object_index.pixels(), 0) < 300);
  for (int k = 0; k < 6; ++k) CHECK(same_planes(traced_by(1 + k % 2, place, clip, camera), first));
}

TEST_CASE(
    "Of twice the same triangles and twice the same plants, the same are seen, also when threads build in "
    "parallel") {
  // More than Embree sorts on one thread. Its leaves are in one order since version 2.5.
  Scenery place;
  const auto hills = [](double x, double y) { return std::sin(x) * std::cos(0.7 * y); };
  const shapes::Shape ground = shapes::field(100, 100, 1, hills);
  place.surface(kGround, shapes::joined(ground, shapes::painted(ground, 2)));
  const auto ball = static_cast<std::uint32_t>(place.mesh(shapes::ball(0.3, 4, 3, 0.5)));
  place.plants = {{.object = kTree, .transform = {}, .mesh = {}},
                  {.object = kShrub, .transform = {}, .mesh = {}}};
  for (int k = 0; k < 20000; ++k) {
    for (Scenery::Plants& plants : place.plants) {
      plants.transform.push_back(upright(std::fmod(0.618 * k, 100) - 50, 0.005 * k - 50, 0.3, k));
      plants.mesh.push_back(ball);
    }
  }
  Clip clip = {.camera_to_world = {looking({-40, -40, 30}, {0, 0, 0})}, .poses = {}};
  const CameraIntrinsics camera = pinhole(320, 256, 250);
  const Passes first = traced_by(1, place, clip, camera);
  CHECK(same_planes(traced_by(2, place, clip, camera), first));
  CHECK(same_planes(traced_by(2, place, clip, camera), first));
}

}  // namespace repeats_test
