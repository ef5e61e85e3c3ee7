#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "support/catch.h"
#include "support/traced.h"

// What level water mirrors: against boxes, whose images are computed by hand.

namespace mirrors_test {

using namespace small_scene;
using thermal::Passes;

namespace {

constexpr thermal::PassNeeds kMirrored = {.depth = true, .normals = true, .actors = true, .mirrored = true};
const CameraIntrinsics kCamera = pinhole(240, 180, 210);

thermal::ManifestObject named(std::uint16_t index, const std::string& material) {
  thermal::ManifestObject object;
  object.index = index;
  object.name = object.material = material;
  return object;
}

thermal::BakedScene with_objects(const Scenery& accelerator) {
  thermal::BakedScene scene = accelerator.baked();
  scene.objects = {named(kGround, "soil"), named(kWater, "water"), named(kTree, "wood")};
  scene.mirrors = {"water"};
  return scene;
}

Passes seen(const Scenery& accelerator, Clip clip, const thermal::PassNeeds& needs = kMirrored,
            const thermal::Sampling& sampling = {}) {
  const thermal::BakedScene scene = with_objects(accelerator);
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  Passes passes;
  thermal::ClipTracer(caster, track, kCamera, sampling).trace(0, needs, passes);
  return passes;
}

/// Ground 2 m below water at a height, a post of 1 x 1 x 4 m on the water's far side, and an actor of the same size
/// beside it.
Scenery shore(double water_m) {
  const auto base = static_cast<float>(water_m);
  Scenery accelerator;
  accelerator.surface(kGround, shapes::level(400, 4, 0, water_m - 2));
  accelerator.surface(kWater, shapes::level(200, 4, 0, water_m));
  accelerator.plant(kTree, shapes::box({-4, 19.5F, base - 1}, {-3, 20.5F, base + 4}, 0), kIdentity);
  accelerator.actor({shapes::box({3, 19.5F, base - 1}, {4, 20.5F, base + 4}, 0)});
  return accelerator;
}

Clip from(double height_m) {
  return {.camera_to_world = {looking({0, -20, height_m}, {0, 12, height_m - 12})}, .poses = {{{kIdentity}}}};
}

struct Hit {
  std::uint16_t object = 0;
  double depth_m = 0;
};

/// What a pixel of water mirrors, from plane geometry: the ray is turned upwards at the water, and meets the front of a
/// box, 39.5 m to the north of the camera, or its side.
Hit mirrored_at(int x, int y, const std::array<double, 16>& pose, double water_m) {
  const double rx = (x + 0.5 - kCamera.cx_px) / kCamera.fx_px;
  const double ry = (y + 0.5 - kCamera.cy_px) / kCamera.fy_px;
  const auto world = [&](std::size_t row) {
    return pose.at(4 * row) * rx + pose.at(4 * row + 1) * ry + pose.at(4 * row + 2);
  };
  const double down = -world(2);
  if (down <= 0) return {};
  const double to_water = (pose[11] - water_m) / down;
  for (const auto& [object, low_m] : {std::pair{kTree, -4.0}, std::pair{kFirstActor, 3.0}}) {
    double near = to_water;
    double far = 1e9;
    const std::array<std::array<double, 2>, 3> sides = {
        {{low_m, low_m + 1}, {19.5, 20.5}, {water_m, water_m + 4}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from_m = axis == 2 ? 2 * water_m - pose[11] : pose.at(4 * axis + 3);
      const double along = axis == 2 ? down : world(axis);
      const double a = (sides.at(axis)[0] - from_m) / along;
      const double b = (sides.at(axis)[1] - from_m) / along;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    if (near < far && near > to_water) return {.object = object, .depth_m = near};
  }
  return {};
}

}  // namespace

TEST_CASE("Level water mirrors a post and a body where plane geometry has their images") {
  for (const double water_m : {0.0, -3.25, 812.5}) {
    Clip clip = from(water_m + 8);
    const auto pose = clip.camera_to_world[0];
    const Passes passes = seen(shore(water_m), clip);
    REQUIRE_FALSE(passes.mirrored.empty());
    int mirrored = 0;
    int wrong = 0;
    double worst_m = 0;
    for (int y = 0; y < kCamera.height_px; ++y) {
      for (int x = 0; x < kCamera.width_px; ++x) {
        const std::uint16_t object = passes.mirrored.object_index.at(x, y);
        if (passes.object_index.at(x, y) != kWater) {
          REQUIRE(object == 0);
          continue;
        }
        const Hit expected = mirrored_at(x, y, pose, water_m);
        wrong += object != expected.object ? 1 : 0;
        if (object == 0 || object != expected.object) continue;
        ++mirrored;
        worst_m = std::max(
            worst_m, std::abs(static_cast<double>(passes.mirrored.depth_m.at(x, y)) - expected.depth_m));
      }
    }
    CAPTURE(water_m, mirrored);
    CHECK(mirrored > 100);
    CHECK(wrong <= 1);      // a silhouette within 1e-4 px of a pixel's centre
    CHECK(worst_m < 1e-4);  // corners in single precision, up to 800 m from the origin: 6e-5 m
  }
}

TEST_CASE("A mirrored front faces the ray that comes from the water") {
  const Passes passes = seen(shore(0), from(8));
  for (int y = 0; y < kCamera.height_px; ++y) {
    for (int x = 0; x < kCamera.width_px; ++x) {
      if (passes.mirrored.object_index.at(x, y) == 0) continue;
      const bool front = passes.mirrored.normal[1].at(x, y) < -0.999F;
      const bool side = std::abs(passes.mirrored.normal[0].at(x, y)) > 0.999F;
      REQUIRE((front || side));
    }
  }
}

TEST_CASE("Waters of several heights each mirror at their own") {
  Scenery accelerator;
  accelerator.surface(kWater, shapes::box({-30, -20, -1}, {0, 19, 0}, 0));
  accelerator.surface(kWater, shapes::box({0, -20, -1}, {30, 19, 2}, 0));
  accelerator.plant(kTree, shapes::box({-30, 19.5F, -1}, {30, 20.5F, 5}, 0), kIdentity);
  Clip clip = {.camera_to_world = {looking({0, -30, 12}, {0, 12, 0})}, .poses = {}};
  const Passes passes = seen(accelerator, clip);
  int left = 0;
  int right = 0;
  for (int x = 0; x < kCamera.width_px; ++x) {
    for (int y = 0; y < kCamera.height_px; ++y)
      (x < kCamera.width_px / 2 ? left : right) += passes.mirrored.object_index.at(x, y) == kTree ? 1 : 0;
  }
  // The wall stands 5 m above the one and 3 m above the other.
  CHECK(left > 300);
  CHECK(right > 150);
  CHECK(right < left);
}

TEST_CASE("A place without water has no mirrored planes, and neither does a picture that mirrors only sky") {
  Scenery dry = shore(0);
  dry.surfaces.pop_back();
  CHECK(seen(dry, from(8)).mirrored.empty());
  Scenery open;
  open.surface(kWater, shapes::level(200, 4, 0, 0));
  CHECK(seen(open, {.camera_to_world = {looking({0, -20, 8}, {0, 12, -4})}, .poses = {}}).mirrored.empty());
  CHECK(seen(shore(0), from(8), kAllPlanes).mirrored.empty());
}

TEST_CASE("What is seen directly does not depend on what is mirrored") {
  CHECK(same_planes(seen(shore(0), from(8)), seen(shore(0), from(8), kAllPlanes)));
}

TEST_CASE("What is mirrored does not depend on the number of threads") {
  Passes one;
  Passes three;
  thermal::with_threads(1, [&] { one = seen(shore(0), from(8)); });
  thermal::with_threads(3, [&] { three = seen(shore(0), from(8)); });
  CHECK(one.mirrored.object_index == three.mirrored.object_index);
  CHECK(one.mirrored.material_index == three.mirrored.material_index);
  CHECK(one.mirrored.depth_m == three.mirrored.depth_m);
  CHECK(one.mirrored.normal == three.mirrored.normal);
}

TEST_CASE("Adaptive sampling has all samples at mirrored silhouettes, whatever is needed") {
  constexpr int kSide = 3;
  const Passes full = seen(shore(0), from(8), kMirrored, {.supersample = kSide});
  const Passes some = seen(shore(0), from(8), kMirrored, {.supersample = kSide, .adaptive = true});
  const thermal::FineSamples& fine = some.fine;
  const Passes direct = seen(shore(0), from(8), kAllPlanes, {.supersample = kSide, .adaptive = true});
  CHECK(direct.fine.x_px == fine.x_px);
  std::size_t mirrored = 0;
  for (int y = 0; y < kCamera.height_px; ++y) {
    const std::size_t begin = fine.row_begin[static_cast<std::size_t>(y)];
    for (std::size_t pixel = 0; pixel < fine.pixels_in(y); ++pixel) {
      for (int k = 0; k < kSide * kSide; ++k) {
        const int line = k / kSide;
        const int column = k % kSide;
        const std::size_t at =
            fine.line_begin(y, line) + pixel * std::size_t{kSide} + static_cast<std::size_t>(column);
        const int x = fine.x_px[begin + pixel] * kSide + column;
        REQUIRE(fine.mirrored.object_index[at] == full.mirrored.object_index.at(x, y * kSide + line));
        REQUIRE(fine.mirrored.depth_m[at] == full.mirrored.depth_m.at(x, y * kSide + line));
        mirrored += fine.mirrored.object_index[at] != 0 ? 1U : 0U;
      }
    }
  }
  CHECK(mirrored > 100);
}

TEST_CASE("What samples alone see mirrored is also said of pixels, which mirror sky") {
  // Between the middles of two columns of pixels, over their inner samples.
  Scenery accelerator;
  accelerator.surface(kWater, shapes::level(200, 4, 0, 0));
  accelerator.actor({shapes::box({-0.05F, 19.5F, -1}, {0.05F, 20.5F, 4}, 0)});
  const Passes passes = seen(accelerator, from(8), kMirrored, {.supersample = 3, .adaptive = true});
  CHECK(std::ranges::count(passes.fine.mirrored.object_index, kFirstActor) > 20);
  REQUIRE(passes.mirrored.object_index.size() == passes.object_index.size());
  CHECK(std::ranges::count(passes.mirrored.object_index.pixels(), 0) ==
        static_cast<std::ptrdiff_t>(passes.object_index.size()));
  CHECK(passes.mirrored.depth_m.at(0, 0) >= thermal::kSkyFromM);
}

}  // namespace mirrors_test
