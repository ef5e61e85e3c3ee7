#include "dataset/run/estimate.h"

#include "support/catch.h"

namespace estimate_test {

using namespace thermal;

namespace {

Config config_of(Engine engine, int supersample, bool adaptive) {
  Config config;
  config.engine = engine;
  config.supersample = supersample;
  config.adaptive_sampling = adaptive;
  return config;
}

/// Seconds that a frame adds.
double frame_s(const Config& config) {
  return (estimate_run(config, 1, 1001).seconds - estimate_run(config, 1, 1).seconds) / 1000;
}

double frame_s(Engine engine, int supersample, bool adaptive = false) {
  return frame_s(config_of(engine, supersample, adaptive));
}

}  // namespace

TEST_CASE("A frame of 640 x 512 takes as long as its engine has taken on two cores") {
  // One clip of configs/savanna.json by Blender (README), all four by Embree (thermal_core/ACCURACY.md).
  CHECK(1 / frame_s(Engine::blender, 1) == Approx(5.8).epsilon(0.4));
  CHECK(1 / frame_s(Engine::blender, 2) == Approx(1.9).epsilon(0.4));
  CHECK(1 / frame_s(Engine::embree, 1) == Approx(31).epsilon(0.2));
  CHECK(1 / frame_s(Engine::embree, 2) == Approx(12).epsilon(0.2));
  CHECK(1 / frame_s(Engine::embree, 2, true) == Approx(16).epsilon(0.2));
}

TEST_CASE("Adaptive sampling takes less time for rays, but no less at one ray per pixel") {
  constexpr double kFrameS = 0.012;
  const double full = frame_s(Engine::embree, 2) - kFrameS;
  CHECK((frame_s(Engine::embree, 2, true) - kFrameS) / full == Approx(0.7));
  CHECK(frame_s(Engine::embree, 1, true) == frame_s(Engine::embree, 1));
}

TEST_CASE("The start counts once, clips and overscan add to it, and disk space is that of the frames") {
  Config config = config_of(Engine::embree, 1, false);
  CHECK(estimate_run(config, 0, 0).seconds == 15);
  CHECK(estimate_run(config, 10, 0).seconds == Approx(16));
  const double plain = frame_s(config);
  const double bytes = estimate_run(config, 1, 100).bytes;
  config.overscan_px = 64;
  CHECK(frame_s(config) - 0.012 == Approx((plain - 0.012) * 768 / 640 * 640 / 512));
  CHECK(estimate_run(config, 1, 100).bytes == bytes);
  config.engine = Engine::blender;
  CHECK(estimate_run(config, 1, 100).bytes == bytes);
  CHECK(bytes == Approx(640.0 * 512 * 2.2 * 100));
}

}  // namespace estimate_test
