// Compares ThermalCamera::noise_w_m2_sr() with the frames of many clips.
#include <cmath>

#include "support/cameras.h"
#include "support/catch.h"
#include "support/statistics.h"

namespace pixel_noise_test {

using namespace thermal;

namespace {

constexpr int kSide = 64;
constexpr double kRateHz = 30;
constexpr double kSceneK = 300;

cameras::ClipOf clip(std::uint32_t seed) {
  return {.width_px = kSide, .height_px = kSide, .seed = seed, .frame_rate_hz = kRateHz};
}

/// Mean square [W^2 m^-4 sr^-2] of the difference of a clip's frames, five intervals of the shutter, from a uniform
/// scene.
double mean_square(const SensorParameters& parameters, std::uint32_t seed) {
  constexpr int kFrames = 150;
  const double per_k = BandRadiance(parameters.response).evaluate(kSceneK).derivative_w_m2_sr_k;
  const Plane<float> scene = cameras::uniform_scene(kSide, kSide, kSceneK);
  ThermalCamera camera = cameras::camera(parameters, clip(seed));
  double sum = 0;
  SensorFrame frame;
  for (int k = 0; k < kFrames; ++k) {
    camera.expose(scene, frame);
    for (const std::uint16_t count : frame.ir16.pixels()) {
      const double off = per_k * (count * parameters.kelvin_per_count - kSceneK);
      sum += off * off;
    }
  }
  return sum / (kSide * kSide * kFrames);
}

/// Clips are independent of each other, so their mean squares scatter about the variance. A kelvin is the same
/// radiance to 0.3 % within 0.2 K of 300 K, and counts of 5 mK round by 1.4 mK, a thousandth of the variance.
void check_noise(const SensorParameters& parameters) {
  constexpr int kClips = 16;
  const double sigma = cameras::camera(parameters, clip(1)).noise_w_m2_sr(0, 0);
  double sum = 0;
  double squares = 0;
  for (std::uint32_t seed = 1; seed <= kClips; ++seed) {
    const double ratio = mean_square(parameters, seed) / (sigma * sigma);
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / kClips;
  const double error = std::sqrt((squares / kClips - mean * mean) / (kClips - 1));
  CAPTURE(mean, error);
  CHECK(error < 0.015);  // each part below is a tenth of the whole or more, so a missing one fails
  CHECK(std::abs(mean - 1) < statistics::kSigmas * error + 0.003);
}

SensorParameters white() {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise.amount = 1;
  parameters.kelvin_per_count = 0.005;  // 16 bits reach 327 K
  return parameters;
}

}  // namespace

TEST_CASE("A pixel's white noise, 1/f noise, fixed pattern and drift have the stated variance") {
  SensorParameters parameters = white();
  parameters.noise.flicker_knee_hz = 1;
  parameters.noise.fixed_pattern_ratio = 1;
  parameters.noise.drift_ratio = 2;
  parameters.shutter = {.interval_s = 1, .freeze_s = 0};
  check_noise(parameters);
}

TEST_CASE("Rows, columns and bands do too") {
  SensorParameters parameters = white();
  parameters.noise.row_ratio = 1;
  parameters.noise.column_ratio = 1;
  parameters.noise.temporal_row_ratio = 1;
  parameters.noise.temporal_column_ratio = 1;
  parameters.noise.banding_ratio = 1;
  check_noise(parameters);
}

}  // namespace pixel_noise_test
