#include <cstdint>
#include <vector>

#include "support/catch.h"
#include "support/grove.h"
#include "support/ray_comparison.h"
#include "support/traced.h"

namespace actors_test {

using namespace small_scene;
using thermal::Passes;

namespace {

constexpr std::uint16_t kFirst = kFirstActor;
constexpr std::uint16_t kSecond = kFirstActor + 1;

/// A camera at the origin that looks along x, 9 x 9 px of 1 m at a depth of 6 m.
CameraIntrinsics camera() { return pinhole(9, 9, 6); }
Clip eastwards(std::size_t frames = 1) {
  return {.camera_to_world = std::vector(frames, looking({0, 0, 0}, {1, 0, 0})), .poses = {}};
}

/// A board of 3 m across the view.
shapes::Shape board(std::uint16_t material) {
  return shapes::box({-.1F, -1.5F, -1.5F}, {.1F, 1.5F, 1.5F}, material);
}

ray_truth::Comparison check_right(const Scenery& place, Clip& clip, const CameraIntrinsics& camera,
                                  std::size_t frame = 0) {
  const Passes passes = traced(place, clip, camera, frame);
  const ray_truth::Comparison found = ray_truth::compare(place, clip, frame, camera, passes);
  INFO("frame " << frame << ", " << found.wrong << " pixels are wrong\n" << found.faults);
  CHECK(found.wrong == 0);
  return found;
}

}  // namespace

TEST_CASE("An actor behind a plant is in the layer of actors alone") {
  Scenery place;
  place.plant(kTree, board(1), upright(4, 0, 0));
  place.actor({board(2)});
  Clip clip = eastwards();
  clip.poses = {{{posed(6, 0, 0)}}};
  const Passes passes = traced(place, clip, camera());
  CHECK(passes.object_index.at(4, 4) == kTree);
  CHECK(passes.material_index.at(4, 4) == 1);
  CHECK(passes.depth_m.at(4, 4) == 3.9F);
  CHECK(passes.actor_index.at(4, 4) == kFirst);
  CHECK(passes.actor_index.at(1, 4) == 0);
}

TEST_CASE("An actor in front of a plant is in both") {
  Scenery place;
  place.plant(kTree, board(1), upright(6, 0, 0));
  place.surface(kGround, shapes::box({8, -90, -90}, {9, 90, 90}, 3));
  place.actor({board(2)});
  Clip clip = eastwards();
  clip.poses = {{{posed(4, 1, 0)}}};
  const Passes passes = traced(place, clip, camera());
  CHECK(passes.object_index.at(3, 4) == kFirst);
  CHECK(passes.actor_index.at(3, 4) == kFirst);
  CHECK(passes.depth_m.at(3, 4) == 3.9F);
  CHECK(passes.object_index.at(5, 4) == kTree);
  CHECK(passes.actor_index.at(5, 4) == 0);
  CHECK(passes.object_index.at(8, 4) == kGround);
}

TEST_CASE("Actors hide each other in their layer too") {
  Scenery place;
  place.actor({board(1)});
  place.actor({board(2)});
  Clip clip = eastwards();
  clip.poses = {{{posed(6, 0, 0)}}, {{posed(5, 1, 0)}}};
  const Passes passes = traced(place, clip, camera());
  CHECK(passes.actor_index.at(4, 4) == kSecond);
  CHECK(passes.actor_index.at(5, 4) == kFirst);
  CHECK(passes.object_index == passes.actor_index);
}

TEST_CASE("Where an actor and the ground pass through each other, the nearer is seen") {
  Scenery place;
  place.surface(kGround, shapes::field(30, 6, 1, [](double x, double y) { return 0.1 * x + 0.05 * y; }));
  place.actor({shapes::ball(1.5, 5, 2), shapes::smoothed(shapes::ball(1, 4, 3))});
  Clip clip = {.camera_to_world = {looking({-7, 1, 4}, {0, 0, 0})},
               .poses = {{{posed(0, 0, 0.2, 0.3), posed(2, 1.5, -0.2)}}}};
  const ray_truth::Comparison found = check_right(place, clip, pinhole(60, 40, 50));
  CHECK(found.actors > 100);
  CHECK(found.hidden > 50);
}

TEST_CASE("Every bone is where the track has it, whichever actors are posed") {
  Scenery place;
  place.surface(kGround, shapes::level(60, 2, 1, -1));
  place.actor({shapes::box({-.5F, -.2F, -.3F}, {.5F, .2F, .3F}, 2)});
  place.actor({shapes::cube(0.7, 3), shapes::ball(0.4, 3, 4), shapes::smoothed(shapes::ball(0.5, 4, 5))});
  place.actor({});
  place.actor({shapes::cube(1, 6), shapes::cube(0.5, 7)});
  const auto bones = [](int actor, int frame, int count) {
    std::vector<Matrix> all;
    for (int bone = 0; bone < count; ++bone)
      all.push_back(
          posed(1.5 * bone - 1, 2.2 * actor - 3 + 0.3 * frame, 0.4 * bone, 0.5 * actor + 0.3 * frame));
    return all;
  };
  Clip clip = {.camera_to_world = std::vector(4, looking({-6, 2, 5}, {0, 0, 0})),
               .poses = {{bones(0, 0, 1), {}, bones(0, 2, 1), bones(0, 3, 1)},
                         {{}, {}, bones(1, 2, 3), bones(1, 3, 3)},
                         {{}, {}, {}, {}},
                         {bones(3, 0, 2), {}, {}, bones(3, 3, 2)}}};
  for (std::size_t frame = 0; frame < 4; ++frame) {
    const ray_truth::Comparison found = check_right(place, clip, pinhole(40, 30, 28), frame);
    CHECK((found.actors > 30) == (frame != 1));
  }
}

TEST_CASE("Plants and actors of the grove are hidden from no side") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  clip.camera_to_world = std::vector(3, looking({-9, -6, 1.5}, {4, 3, 1.5}));  // low, behind a shrub
  int hidden = 0;
  for (std::size_t frame = 0; frame < 3; ++frame)
    hidden += check_right(place, clip, grove::camera(), frame).hidden;
  CHECK(hidden > 5);
}

TEST_CASE("An actor of a pixel is seen where its centre is") {
  // Boards of 1 m at 50 m, a pixel wide and high, beside each other by some pixels and a third of one.
  Scenery place;
  place.surface(kGround, shapes::box({60, -90, -90}, {61, 90, 90}, 1));
  Clip clip = eastwards();
  for (int k = 0; k < 12; ++k) {
    place.actor({shapes::box({0, -.5F, -.5F}, {.01F, .5F, .5F}, 2)});
    clip.poses.push_back({{posed(50, 3.34 * k - 18, 2.34 * k - 13)}});
  }
  const CameraIntrinsics fifty = pinhole(40, 30, 50);
  const Passes passes = traced(place, clip, fifty);
  CHECK(check_right(place, clip, fifty).actors == 12);
  for (std::uint16_t k = 0; k < 12; ++k)
    CHECK(std::ranges::count(passes.object_index.pixels(), kFirstActor + k) == 1);
}

TEST_CASE("Without actors their layer is empty") {
  Scenery place = grove::place();
  Clip clip = grove::clip();
  clip.poses = {{{}, {}, {}}, {{}, {}, {}}};
  const Passes parked = traced(place, clip, grove::camera());
  CHECK(parked.actor_index == thermal::Plane<std::uint16_t>(53, 41));
  place.actors.clear();
  clip.poses.clear();
  CHECK(same_planes(traced(place, clip, grove::camera()), parked));
}

}  // namespace actors_test
