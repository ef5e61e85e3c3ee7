#include <cmath>

#include "sensor/flicker_noise.h"
#include "support/cameras.h"
#include "support/catch.h"

namespace camera_noise_test {

using namespace thermal;
using cameras::camera;
using cameras::uniform_scene;

namespace {

SensorParameters white_only() {
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.noise.amount = 1;
  return parameters;
}

double noise_of(const SensorParameters& parameters) {
  return camera(parameters, {.width_px = 4, .height_px = 3}).noise_w_m2_sr(1, 2);
}

double white() {
  const BandRadiance band(white_only().response);
  return 0.04 * band.evaluate(300).derivative_w_m2_sr_k;
}

}  // namespace

TEST_CASE("A pixel's noise is its NETD without other components") {
  CHECK_THAT(noise_of(white_only()), WithinRel(white(), 1e-6));  // single precision
  CHECK(noise_of(cameras::perfect_sensor()) == 0);
}

TEST_CASE("Patterns add to it in quadrature; noise shared by whole frames does not") {
  SensorParameters parameters = white_only();
  parameters.noise.fixed_pattern_ratio = 2;
  parameters.noise.row_ratio = 3;
  parameters.noise.column_ratio = 4;
  parameters.noise.temporal_row_ratio = 1;
  parameters.noise.temporal_column_ratio = 5;
  parameters.noise.banding_ratio = 6;
  parameters.noise.frame_ratio = 100;
  parameters.noise.drift_ratio = 100;  // needs a shutter
  CHECK_THAT(noise_of(parameters), WithinRel(white() * std::sqrt(1.0 + 4 + 9 + 16 + 1 + 25 + 36), 1e-6));
}

TEST_CASE("The 1/f part and the drift count by their variances") {
  SensorParameters parameters = white_only();
  parameters.noise.flicker_knee_hz = 2;
  const double flicker = 2 * FlickerDesign::fit(9, 2).variance();
  CHECK_THAT(noise_of(parameters), WithinRel(white() * std::sqrt(1 + flicker), 1e-6));
  parameters.noise.flicker_knee_hz = 0;
  parameters.noise.drift_ratio = 2;
  parameters.shutter.interval_s = 60;
  // The mean of (sqrt(t) / 2 + t / 2)^2 = t / 4 + t^1.5 / 2 + t^2 / 4 from 0 to 1: 1/8 + 1/5 + 1/12.
  CHECK_THAT(noise_of(parameters),
             WithinRel(white() * std::sqrt(1 + 4 * (1 / 8.0 + 1 / 5.0 + 1 / 12.0)), 1e-6));
}

TEST_CASE("The paper's pattern is scaled by the first frame, and counts from then on") {
  SensorParameters parameters = white_only();
  parameters.noise.first_frame_ratio = 0.5;
  ThermalCamera used = camera(parameters, {.width_px = 4, .height_px = 4});
  CHECK_THAT(used.noise_w_m2_sr(0, 0), WithinRel(white(), 1e-6));
  Plane<float> halves(4, 4, 30);
  for (int x = 0; x < 4; ++x) halves.at(x, 0) = halves.at(x, 1) = 50;  // standard deviation 10
  (void)used.expose(halves);
  CHECK_THAT(used.noise_w_m2_sr(0, 0), WithinRel(std::hypot(white(), 5 / std::sqrt(3)), 1e-6));
}

TEST_CASE("The look receives the picture behind the optics, and looking changes nothing") {
  SensorParameters parameters = cameras::full_sensor();
  parameters.optics = {.psf = Psf::gaussian, .blur_sigma_px = 0};
  const cameras::ClipOf clip = {.width_px = 17, .height_px = 9};
  ThermalCamera watched = camera(parameters, clip);
  ThermalCamera alone = camera(parameters, clip);
  for (int k = 0; k < 5; ++k) {
    const Plane<float> scene = uniform_scene(17, 9, 280 + k);
    SensorFrame frame;
    int looks = 0;
    watched.expose(scene, frame, [&](const Plane<float>& plane) {
      ++looks;
      CHECK(plane == scene);
    });
    CHECK(looks == 1);
    CHECK(cameras::same_pixels(frame, alone.expose(scene)));
  }
}

TEST_CASE("The 16-bit picture is made from apparent temperature") {
  const ThermalCamera used = camera(cameras::perfect_sensor(), {.width_px = 1, .height_px = 1});
  // The table's error and single precision at 300 K.
  CHECK_THAT(used.temperature_k(static_cast<double>(cameras::radiance_at(300))), WithinAbs(300, 1.5e-4));
  CHECK(used.temperature_k(0) == 0);
}

}  // namespace camera_noise_test
