#include "raycast/bare_trace.h"

#include <algorithm>

#include "support/catch.h"
#include "support/traced.h"

namespace bare_trace_test {

using namespace small_scene;

TEST_CASE("Embree alone hits what the passes show, in packets that are not full as well") {
  Scenery place;
  place.surface(kGround, shapes::level(10, 4, 1));
  place.plant(kTree, shapes::cube(2, 1), upright(3, 5, 1));
  Clip clip = {.camera_to_world = {looking_down(1, 2, 9)}, .poses = {}};
  const CameraIntrinsics camera = pinhole(45, 38, 30);
  const thermal::Passes passes = traced(place, clip, camera);
  const auto sky = std::ranges::count(passes.object_index.pixels(), 0);
  const thermal::BakedScene scene = place.baked();
  thermal::BareTracer bare(scene);
  CHECK(bare.hits() == 0);
  bare.aim(clip.camera_to_world[0], camera);
  CHECK(sky > 100);
  CHECK(bare.hits() == 45 * 38 - static_cast<std::size_t>(sky));
}

}  // namespace bare_trace_test
