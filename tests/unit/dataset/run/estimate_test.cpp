#include "dataset/run/options.h"
#include "support/catch.h"

namespace estimate_test {

using namespace thermal;

namespace {

DatasetSpec spec_of(Engine engine, int supersample, bool adaptive) {
  DatasetSpec spec;
  spec.engine = engine;
  spec.supersample = supersample;
  spec.adaptive_sampling = adaptive;
  return spec;
}

/// Seconds that a frame adds.
double frame_s(const DatasetSpec& spec) {
  return (estimate_run(spec, 1, 1001).seconds - estimate_run(spec, 1, 1).seconds) / 1000;
}

double frame_s(Engine engine, int supersample, bool adaptive = false) {
  return frame_s(spec_of(engine, supersample, adaptive));
}

}  // namespace

TEST_CASE("A frame of 640 x 512 takes as long as its engine has taken on two cores") {
  // One clip of configs/savanna.json by Blender (README), all four by Embree (thermal_core/ACCURACY.md).
  CHECK_THAT(1 / frame_s(Engine::blender, 1), WithinAbs(5.8, 0.4 * 5.8));
  CHECK_THAT(1 / frame_s(Engine::blender, 2), WithinAbs(1.9, 0.4 * 1.9));
  CHECK_THAT(1 / frame_s(Engine::embree, 1), WithinAbs(31.0, 0.2 * 31.0));
  CHECK_THAT(1 / frame_s(Engine::embree, 2), WithinAbs(12.0, 0.2 * 12.0));
  CHECK_THAT(1 / frame_s(Engine::embree, 2, true), WithinAbs(16.0, 0.2 * 16.0));
}

TEST_CASE("Adaptive sampling takes less time for rays, but no less at one ray per pixel") {
  constexpr double kFrameS = 0.012;
  const double full = frame_s(Engine::embree, 2) - kFrameS;
  CHECK_THAT((frame_s(Engine::embree, 2, true) - kFrameS) / full, WithinRel(0.7, 1e-6));
  CHECK(frame_s(Engine::embree, 1, true) == frame_s(Engine::embree, 1));
}

TEST_CASE("The start counts once, clips and overscan add to it, and disk space is that of the frames") {
  DatasetSpec spec = spec_of(Engine::embree, 1, false);
  CHECK(estimate_run(spec, 0, 0).seconds == 15);
  CHECK_THAT(estimate_run(spec, 10, 0).seconds, WithinRel(16.0, 1e-6));
  const double plain = frame_s(spec);
  const double bytes = estimate_run(spec, 1, 100).bytes;
  spec.overscan_px = 64;
  CHECK_THAT(frame_s(spec) - 0.012, WithinRel((plain - 0.012) * 768 / 640 * 640 / 512, 1e-6));
  CHECK(estimate_run(spec, 1, 100).bytes == bytes);
  spec.engine = Engine::blender;
  CHECK(estimate_run(spec, 1, 100).bytes == bytes);
  CHECK_THAT(bytes, WithinRel(640.0 * 512 * 2.2 * 100, 1e-6));
}

}  // namespace estimate_test
