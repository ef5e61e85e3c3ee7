#include "imaging/motion_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/catch.h"

namespace motion_finder_test {

using namespace thermal;

namespace {

constexpr float kDepthM = 100;
constexpr double kFocalPx = 800;
constexpr float kPxPerM = static_cast<float>(kFocalPx) / kDepthM;

/// Above (x, y), looking straight down; the top of the picture is north.
std::array<double, 16> above(double x_m, double y_m) {
  return {1, 0, 0, x_m, 0, -1, 0, y_m, 0, 0, -1, 100, 0, 0, 0, 1};
}

Manifest still_clip(int frames) {
  Manifest manifest;
  manifest.frame_rate_hz = 30;
  manifest.camera = {
      .width_px = 64, .height_px = 48, .fx_px = kFocalPx, .fy_px = kFocalPx, .cx_px = 32, .cy_px = 24};
  ManifestObject walker;
  walker.index = 5;
  walker.object_class = ObjectClass::actor;
  manifest.objects = {walker};
  for (int n = 0; n < frames; ++n) {
    ManifestFrame frame;
    frame.time_s = n / 30.0;
    frame.camera_to_world = above(0, 0);
    frame.actors = {{.index = 5, .position_m = {0, 0, 0}}};
    manifest.frames.push_back(frame);
  }
  return manifest;
}

/// Ground at one depth, with an actor of 4 x 4 pixels in the middle, a metre high.
Passes scene(int width = 64, int height = 48) {
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(width, height, 1);
  passes.depth_m = Plane<float>(width, height, kDepthM);
  for (int y = height / 2 - 2; y < height / 2 + 2; ++y) {
    for (int x = width / 2 - 2; x < width / 2 + 2; ++x) {
      passes.object_index.at(x, y) = 5;
      passes.depth_m.at(x, y) = kDepthM - 1;
    }
  }
  return passes;
}

ImageMotion motion_in(const Manifest& manifest, int frame, const Passes& passes) {
  ImageMotion motion;
  MotionFinder(manifest, manifest.lens).find(passes, frame, motion);
  return motion;
}

}  // namespace

TEST_CASE("Nothing moves before a still camera, in a clip of one frame, or without poses or depth") {
  CHECK(motion_in(still_clip(2), 1, scene()).empty());
  CHECK(motion_in(still_clip(1), 0, scene()).empty());
  Manifest moving = still_clip(2);
  moving.frames[1].camera_to_world = above(1, 0);
  CHECK_FALSE(motion_in(moving, 1, scene()).empty());
  Passes flat = scene();
  flat.depth_m = {};
  CHECK(motion_in(moving, 1, flat).empty());
  moving.frames[0].camera_to_world.reset();
  CHECK(motion_in(moving, 1, scene()).empty());
  moving.frames[0].camera_to_world = above(std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK(motion_in(moving, 1, scene()).empty());
}

TEST_CASE("Level ground moves against the camera, and what is nearer moves faster") {
  Manifest manifest = still_clip(3);
  for (int n = 0; n < 3; ++n)
    manifest.frames[static_cast<std::size_t>(n)].camera_to_world = above(0.25 * n, 0.5 * n);
  for (const int frame : {0, 1, 2}) {  // the first by the next
    const ImageMotion motion = motion_in(manifest, frame, scene());
    CHECK_THAT(motion.x_px.at(3, 3), WithinAbs(-0.25F * kPxPerM, 1e-3F));
    CHECK_THAT(motion.y_px.at(60, 40), WithinAbs(0.5F * kPxPerM, 1e-3F));
    CHECK_THAT(motion.x_px.at(32, 24), WithinAbs(-0.25F * kPxPerM * 100 / 99, 1e-3F));
  }
}

TEST_CASE("The sky moves with the camera's turn alone") {
  Manifest manifest = still_clip(2);
  constexpr double kTurn = 0.002;
  const double c = std::cos(kTurn);
  const double s = std::sin(kTurn);
  manifest.frames[1].camera_to_world = {c, 0, s, 10, 0, -1, 0, 0, s, 0, -c, 100, 0, 0, 0, 1};
  Passes passes = scene();
  for (float& depth : passes.depth_m.pixels()) depth = 1e10F;
  // The axis now points towards +x: what is in the middle was to its right, and has moved to the left.
  CHECK_THAT(motion_in(manifest, 1, passes).x_px.at(32, 2),
             WithinAbs(static_cast<float>(-kFocalPx * kTurn), 0.01F));
}

TEST_CASE("Actors move as their poses do, and leave a trail of their motion") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].actors[0].position_m = {0.5, 0, 0};
  const ImageMotion motion = motion_in(manifest, 1, scene());
  const float px = 0.5F * static_cast<float>(kFocalPx) / 99;
  CHECK_THAT(motion.x_px.at(31, 24), WithinAbs(px, 1e-3F));
  CHECK_THAT(motion.x_px.at(27, 24), WithinAbs(px, 1e-3F));  // 3 px behind it, where it has been
  CHECK(motion.x_px.at(24, 24) == 0);
  CHECK(motion.x_px.at(36, 24) == 0);  // ahead of it
  CHECK(motion.y_px.at(31, 24) == 0);
}

TEST_CASE("An actor that turns on the spot moves about its place") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].actors[0].heading_rad = 0.2;
  const ImageMotion motion = motion_in(manifest, 1, scene());
  CHECK(motion.y_px.at(33, 24) <
        0);  // counter-clockwise seen from above, up in the picture to the right of it
  CHECK(motion.y_px.at(30, 24) > 0);
}

TEST_CASE("Pixels without a usable depth do not move") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].camera_to_world = above(1, 0);
  Passes passes = scene();
  passes.depth_m.at(1, 1) = std::numeric_limits<float>::quiet_NaN();
  passes.depth_m.at(2, 1) = -5;
  passes.depth_m.at(3, 1) = 0;
  passes.depth_m.at(4, 1) = std::numeric_limits<float>::infinity();
  const ImageMotion motion = motion_in(manifest, 1, passes);
  for (const int x : {1, 2, 3}) CHECK(motion.x_px.at(x, 1) == 0);
  CHECK_THAT(motion.x_px.at(4, 1), WithinAbs(0, 1e-3F));  // endlessly far
  CHECK_THAT(motion.x_px.at(5, 1), WithinAbs(-kPxPerM, 1e-3F));
}

TEST_CASE("Finer passes, a lens and overscan give the camera's pixels their motion") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].camera_to_world = above(1, 0);
  manifest.supersample = 3;
  CHECK_THAT(motion_in(manifest, 1, scene(192, 144)).x_px.at(5, 5), WithinAbs(-kPxPerM, 1e-3F));
  CHECK_THAT(motion_in(manifest, 1, scene()).x_px.at(5, 5),
             WithinAbs(-kPxPerM, 1e-3F));  // adaptive: one sample each
  manifest.supersample = 1;
  manifest.overscan_px = 8;
  ImageMotion motion;
  const LensDistortion barrel = {.k1 = -0.3};
  MotionFinder(manifest, barrel).find(scene(80, 64), 1, motion);
  CHECK(motion.x_px.width_px() == 64);
  CHECK_THAT(motion.x_px.at(5, 24), WithinAbs(-kPxPerM, 0.02F));
}

TEST_CASE("Passes that are sampled where it matters move as those with all samples do") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].camera_to_world = above(1, 0);
  manifest.supersample = 2;
  Passes adaptive = scene();
  FineSamples& fine = adaptive.fine;
  fine.factor = 2;
  fine.row_begin.assign(49, 0);
  for (int y = 11; y <= 48; ++y) fine.row_begin[static_cast<std::size_t>(y)] = 1;
  fine.x_px = {20};
  fine.object_index = {1, 1, 1, 1};
  fine.depth_m = {kDepthM, kDepthM, kDepthM, kDepthM / 2};
  Passes full = scene(128, 96);
  for (Passes* passes : {&adaptive, &full}) std::ranges::fill(passes->depth_m.pixels(), kDepthM);
  full.depth_m.at(41, 21) = kDepthM / 2;
  const ImageMotion motion = motion_in(manifest, 1, adaptive);
  CHECK(motion.x_px == motion_in(manifest, 1, full).x_px);
  CHECK_THAT(motion.x_px.at(20, 10), WithinAbs(-2 * kPxPerM, 1e-3F));
}

TEST_CASE("Motion over several intervals counts for one") {
  Manifest manifest = still_clip(2);
  manifest.frames[1].camera_to_world = above(1, 0);
  manifest.frames[1].time_s = 4 / 30.0;
  CHECK_THAT(motion_in(manifest, 1, scene()).x_px.at(5, 5), WithinAbs(-kPxPerM / 4, 1e-3F));
}

}  // namespace motion_finder_test
