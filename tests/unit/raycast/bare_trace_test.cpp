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
  const thermal::BareTrace bare = thermal::BareTracer(scene).trace(clip.camera_to_world[0], camera);
  CHECK(sky > 100);
  CHECK(bare.rays == 45 * 38);
  CHECK(bare.hits == bare.rays - static_cast<std::size_t>(sky));
  CHECK(bare.seconds > 0);
}

}  // namespace bare_trace_test
