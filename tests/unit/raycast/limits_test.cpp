#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/catch.h"
#include "support/grove.h"
#include "support/traced.h"

/// Numbers that no plan has, but a damaged file may: Embree ends the program at rays of NaN or of huge numbers.
namespace limits_test {

using namespace small_scene;
using thermal::Passes;

namespace {

/// A floor and a cube on it, with a plant and an actor's bone of this transform.
Passes with_pieces(const Matrix& to_world) {
  Scenery place;
  place.surface(kGround, shapes::level(50, 4, 1, -2));
  place.plant(kTree, shapes::smoothed(shapes::ball(1, 5, 2)), to_world);
  place.actor({shapes::ball(1, 5, 3), shapes::cube(1, 4)});
  Clip clip = {.camera_to_world = {looking({-6, 0, 3}, {0, 0, 0})}, .poses = {{{to_world, posed(2, 1, 0)}}}};
  return traced(place, clip, pinhole(40, 30, 30));
}

bool all_finite(const Passes& passes) {
  const auto is_finite = [](float value) { return std::isfinite(value); };
  return std::ranges::all_of(passes.depth_m.pixels(), is_finite) &&
         std::ranges::all_of(passes.normal, [&](const thermal::Plane<float>& axis) {
           return std::ranges::all_of(axis.pixels(), is_finite);
         });
}

bool is_all_sky(const Passes& passes) {
  const auto is_nothing = [](std::uint16_t index) { return index == 0; };
  return std::ranges::all_of(passes.object_index.pixels(), is_nothing) &&
         std::ranges::all_of(passes.actor_index.pixels(), is_nothing) && all_finite(passes);
}

}  // namespace

TEST_CASE("Pieces that are flattened, too small or too far away are not seen, and all others are") {
  const Passes without = with_pieces(posed(0, 0, -100));
  REQUIRE_FALSE(same_planes(with_pieces(posed(0, 0, 0)), without));
  std::vector<Matrix> transforms = {{1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0}, {}};
  for (const std::array<double, 3>& scale : std::vector<std::array<double, 3>>{{1, 1, 0},
                                                                               {0, 1, 1},
                                                                               {0, 1, 0},
                                                                               {1, 1, 1e-20},
                                                                               {1e-30, 1e-30, 1e-30},
                                                                               {1e12, 1e12, 1e12},
                                                                               {1e38, 1e38, 1e38}})
    transforms.push_back(posed(0, 0, 0, 0.3, scale));
  for (const double far_m : {1e12, 1e19, 1e38}) transforms.push_back(posed(far_m, -far_m, 0));
  for (const Matrix& to_world : transforms) {
    INFO("transform " << Catch::Detail::stringify(to_world));
    const Passes passes = with_pieces(to_world);
    CHECK(same_planes(passes, without));
    CHECK(all_finite(passes));
  }
}

TEST_CASE("A camera without a direction, or too far away, sees the sky") {
  const Scenery place = grove::place();
  const auto plain = grove::clip().camera_to_world[0];
  auto nowhere = plain;
  for (const std::size_t entry : {0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) nowhere.at(entry) = 0;
  std::vector<std::array<double, 16>> poses = {nowhere};
  for (const double huge : {1e10, 1e20, 1e300}) {
    poses.push_back(plain);
    poses.back()[3] = huge;
    poses.push_back(plain);
    for (const std::size_t entry : {2U, 6U, 10U}) poses.back().at(entry) *= 1e18 * huge;
  }
  for (const auto& pose : poses) {
    Clip clip = grove::clip();
    clip.camera_to_world[0] = pose;
    INFO("pose " << Catch::Detail::stringify(pose));
    CHECK(is_all_sky(traced(place, clip, grove::camera())));
  }
}

TEST_CASE("Where a lens shows nothing there is the sky, and other pixels are as they were") {
  const Scenery place = grove::place();
  Clip clip = grove::clip();
  const CameraIntrinsics wide = pinhole(101, 77, 40);
  const thermal::LensDistortion lens = {.k1 = -0.35};  // shows nothing beyond 0.65 focal lengths
  const Passes passes = traced(place, clip, wide, 0, lens);
  long outside = 0;
  for (int y = 0; y < wide.height_px; ++y) {
    for (int x = 0; x < wide.width_px; ++x) {
      CameraIntrinsics one = wide;  // this pixel alone
      one.width_px = one.height_px = 1;
      one.cx_px -= x;
      one.cy_px -= y;
      if (std::isnan(thermal::unproject(wide, lens, {x + 0.5, y + 0.5}).x)) {
        ++outside;
        CHECK(passes.object_index.at(x, y) == 0);
        CHECK(passes.actor_index.at(x, y) == 0);
        CHECK(passes.depth_m.at(x, y) == 1e10F);
      } else if ((x + y) % 7 == 0) {
        const Passes alone = traced(place, clip, one, 0, lens);
        CHECK(passes.object_index.at(x, y) == alone.object_index.at(0, 0));
        CHECK(passes.depth_m.at(x, y) == alone.depth_m.at(0, 0));
      }
    }
  }
  CHECK(outside > 1000);
}

TEST_CASE("Points that are too far away lose their triangles, and no others") {
  shapes::Shape floor = shapes::level(50, 4, 1, -2);
  Scenery place;
  place.surface(kGround, floor);
  Clip clip = {.camera_to_world = {looking({-6, 0, 3}, {0, 0, 0})}, .poses = {}};
  const Passes plain = traced(place, clip, pinhole(40, 30, 30));
  floor.points_m.push_back({1e30F, 0, 0});
  floor.points_m.push_back({0, std::numeric_limits<float>::max(), 0});
  floor.triangles.push_back({0, 1, 25});
  floor.triangles.push_back({25, 26, 2});
  Scenery odd;
  odd.surface(kGround, shapes::smoothed(shapes::painted(floor, 1)));
  const Passes passes = traced(odd, clip, pinhole(40, 30, 30));
  CHECK(passes.object_index == plain.object_index);
  CHECK(passes.depth_m == plain.depth_m);
  CHECK(all_finite(passes));
}

}  // namespace limits_test
