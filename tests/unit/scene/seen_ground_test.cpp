#include "scene/seen_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "support/catch.h"
#include "support/small_scene.h"

namespace seen_ground_test {

using namespace small_scene;
using thermal::GroundMaps;
using thermal::GroundView;

namespace {

constexpr std::size_t kCells = 300;
constexpr std::size_t kSide = kCells / thermal::kBlockCells;
constexpr float kNever = std::numeric_limits<float>::infinity();

template <typename Height>
GroundMaps ground(const Height& height_m) {
  GroundMaps maps;
  maps.size_m = kCells;
  maps.cells = kCells;
  for (std::size_t cell = 0; cell < kCells * kCells; ++cell) {
    const double x_m = static_cast<double>(cell % kCells) + 0.5 - kCells / 2.0;
    const double y_m = static_cast<double>(cell / kCells) + 0.5 - kCells / 2.0;
    maps.height_m.push_back(static_cast<float>(height_m(x_m, y_m)));
  }
  return maps;
}

double flat(double /*x_m*/, double /*y_m*/) { return 0; }

double rolling(double x_m, double y_m) { return 12 * std::sin(0.03 * x_m) * std::cos(0.05 * y_m); }

/// Of the block that holds a place.
float at(const std::vector<float>& pixels_m, double x_m, double y_m) {
  const auto block = [](double place_m) {
    return static_cast<std::size_t>((place_m + kCells / 2.0) / thermal::kBlockCells);
  };
  return pixels_m.at(block(y_m) * kSide + block(x_m));
}

/// Demands that a camera's blocks have been found: those with a point of the ground in the picture, at its depth.
void check_all_seen(const std::vector<float>& pixels_m, const GroundView& view, const GroundMaps& maps) {
  std::size_t seen = 0;
  for (const auto& pose : view.camera_to_world) {
    for (std::size_t cell = 0; cell < maps.height_m.size(); ++cell) {
      const Axis from_m = {static_cast<double>(cell % kCells) + 0.5 - kCells / 2.0 - pose[3],
                           static_cast<double>(cell / kCells) + 0.5 - kCells / 2.0 - pose[7],
                           static_cast<double>(maps.height_m[cell]) - pose[11]};
      const auto along = [&](std::size_t axis) {
        return pose.at(axis) * from_m[0] + pose.at(4 + axis) * from_m[1] + pose.at(8 + axis) * from_m[2];
      };
      if (along(2) <= 0) continue;
      const double u_px = view.camera.cx_px + view.camera.fx_px * along(0) / along(2);
      const double v_px = view.camera.cy_px + view.camera.fy_px * along(1) / along(2);
      if (!(u_px >= 0 && u_px <= view.camera.width_px && v_px >= 0 && v_px <= view.camera.height_px))
        continue;
      ++seen;
      const float pixel_m = pixels_m[cell / kCells / 4 * kSide + cell % kCells / 4];
      REQUIRE(static_cast<double>(pixel_m) <= along(2) / std::sqrt(view.camera.fx_px * view.camera.fy_px));
    }
  }
  CHECK(seen > 1000);
}

}  // namespace

TEST_CASE("A camera that looks down sees a rectangle and its margin") {
  const GroundMaps maps = ground(flat);
  const std::vector<GroundView> views = {
      {.camera = pinhole(64, 48, 80), .camera_to_world = {looking_down(10, -20, 80)}}};
  const std::vector<float> pixels_m = finest_pixels_m(Scenery().baked(), maps, views);
  check_all_seen(pixels_m, views[0], maps);
  // 32 m and 24 m to each side; 4 cells and 3 pixels of 1 m around them, and 3 m from a block's middle to its corner
  for (const double margin_m : {0.0, 6.0}) {
    CHECK(at(pixels_m, 10 + 32 + margin_m, -20) < 1);
    CHECK(at(pixels_m, 10 - 32 - margin_m, -20) < 1);
    CHECK(at(pixels_m, 10, -20 + 24 + margin_m) < 1);
    CHECK(at(pixels_m, 10, -20 - 24 - margin_m) < 1);
  }
  const double beyond_m = 20;
  CHECK(at(pixels_m, 10 + 32 + beyond_m, -20) == kNever);
  CHECK(at(pixels_m, 10 - 32 - beyond_m, -20) == kNever);
  CHECK(at(pixels_m, 10, -20 + 24 + beyond_m) == kNever);
  CHECK(at(pixels_m, 10, -20 - 24 - beyond_m) == kNever);
  CHECK(at(pixels_m, 10, -20) > 0.85F);  // of 1 m at the ground, from the ball around a block
}

TEST_CASE("Oblique cameras above hills see no less than what their pictures show") {
  const GroundMaps maps = ground(rolling);
  thermal::CameraIntrinsics camera = pinhole(64, 48, 60);
  camera.cx_px = 20;
  camera.fy_px = 90;
  const GroundView view = {
      .camera = camera,
      .camera_to_world = {looking({-60, 40, 50}, {20, -10, 0}, {0.2, 0, 1}),
                          looking({90, 40, 30}, {60, 40, 0}), looking({-140, -140, 45}, {140, 140, 30})}};
  const std::vector<float> pixels_m = finest_pixels_m(Scenery().baked(), maps, std::vector{view});
  check_all_seen(pixels_m, view, maps);
  CHECK(std::ranges::count(pixels_m, kNever) > std::ssize(pixels_m) / 5);
}

TEST_CASE("Towards the horizon, pixels get wider with distance, and none lie behind the camera") {
  const std::vector<GroundView> views = {
      {.camera = pinhole(64, 48, 64), .camera_to_world = {looking({-140, 0, 40}, {140, 0, 35})}}};
  const std::vector<float> pixels_m = finest_pixels_m(Scenery().baked(), ground(flat), views);
  CHECK(at(pixels_m, -145, 0) == kNever);
  CHECK(at(pixels_m, -137, 0) == kNever);  // below the picture
  for (const double x_m : {0.0, 70.0, 140.0}) {
    const double depth_m = x_m + 140;
    CHECK(static_cast<double>(at(pixels_m, x_m, 0)) < depth_m / 64);
    CHECK(static_cast<double>(at(pixels_m, x_m, 0)) > 0.8 * depth_m / 64 - 0.3);
  }
}

TEST_CASE("Ground beyond the farthest depth is not seen") {
  thermal::BakedScene scene;
  scene.depth_range_m = {0.1, 100};
  const std::vector<GroundView> views = {
      {.camera = pinhole(64, 48, 64), .camera_to_world = {looking({-140, 0, 40}, {140, 0, 35})}}};
  const std::vector<float> pixels_m = finest_pixels_m(scene, ground(flat), views);
  CHECK(at(pixels_m, -45, 0) < 2);
  CHECK(at(pixels_m, 0, 0) == kNever);
}

TEST_CASE("Ground that water mirrors is seen, at the length of the whole way") {
  // From 10 m above the water, a hill of 40 m is above the picture, and its image in it.
  const auto hill = [](double x_m, double /*y_m*/) { return x_m > 100 ? 40.0 : 0.0; };
  const std::vector<GroundView> views = {
      {.camera = pinhole(64, 20, 64), .camera_to_world = {looking({0, 0, 10}, {120, 0, -40})}}};
  Scenery dry;
  dry.surface(kWater, shapes::level(100, 1, 1));
  thermal::BakedScene scene = dry.baked();
  CHECK(at(finest_pixels_m(scene, ground(hill), views), 120, 0) == kNever);
  scene.materials = {{.index = 1, .material = "water", .part = {}}};
  scene.mirrors = {"water"};
  const float pixel_m = at(finest_pixels_m(scene, ground(hill), views), 120, 0);
  CHECK(pixel_m > 1.5F);  // 130 m away, less what the ball around a block has of it
  CHECK(pixel_m < 130 / 64.0F);
}

TEST_CASE("The finest pixel of all frames counts, in any order and by any number of threads") {
  const GroundMaps maps = ground(rolling);
  const GroundView low = {.camera = pinhole(64, 48, 80), .camera_to_world = {looking_down(10, -20, 40)}};
  const GroundView high = {.camera = pinhole(64, 48, 80),
                           .camera_to_world = {looking_down(20, -10, 90), looking_down(-80, -90, 70)}};
  const thermal::BakedScene scene;
  const auto seen_by = [&](const std::vector<GroundView>& views, int threads) {
    return thermal::with_threads(threads, [&] { return finest_pixels_m(scene, maps, views); });
  };
  std::vector<float> finest = seen_by({low}, 1);
  const std::vector<float> others = seen_by({high}, 1);
  for (std::size_t k = 0; k < finest.size(); ++k) finest[k] = std::min(finest[k], others[k]);
  CHECK(seen_by({low, high}, 1) == finest);
  CHECK(seen_by({high, low}, 3) == finest);
}

TEST_CASE("No view sees nothing") {
  const std::vector<float> pixels_m = finest_pixels_m({}, ground(flat), {});
  CHECK(std::ranges::count(pixels_m, kNever) == std::ssize(pixels_m));
}

}  // namespace seen_ground_test
