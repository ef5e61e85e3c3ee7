#include "scene/camera_geometry.h"

#include "support/catch.h"

namespace camera_geometry_test {

using namespace thermal;

namespace {

constexpr CameraIntrinsics kCamera = {640, 512, 764.5, 765.5, 320.25, 256};

}  // namespace

TEST_CASE("A finer camera sees the same field with more pixels") {
  const CameraIntrinsics fine = finer(kCamera, 4);
  CHECK(fine.width_px == 2560);
  CHECK(fine.height_px == 2048);
  CHECK(fine.fx_px == 4 * 764.5);
  CHECK(fine.fy_px == 4 * 765.5);
  CHECK(fine.cx_px == 1281);
  CHECK(fine.cy_px == 1024);
}

TEST_CASE("The camera of the passes has overscan on every side, then finer pixels") {
  Manifest manifest;
  manifest.camera = kCamera;
  manifest.overscan_px = 10;
  manifest.supersample = 2;
  const CameraIntrinsics passes = passes_camera(manifest);
  CHECK(passes.width_px == 2 * 660);
  CHECK(passes.height_px == 2 * 532);
  CHECK(passes.fx_px == 2 * 764.5);
  CHECK(passes.fy_px == 2 * 765.5);
  CHECK(passes.cx_px == 2 * 330.25);
  CHECK(passes.cy_px == 2 * 266);
}

TEST_CASE("A cryptomatte is a mean over pixels, as if of very many samples") {
  Manifest manifest;
  CHECK(samples_across_pixel(manifest) == 1);
  manifest.supersample = 4;
  CHECK(samples_across_pixel(manifest) == 4);
  manifest.cryptomatte = "CryptoObject";
  CHECK(samples_across_pixel(manifest) >= 4 * 32);
}

}  // namespace camera_geometry_test
