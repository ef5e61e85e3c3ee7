#include "bench/sensor_scene.h"

#include <algorithm>
#include <cmath>

#include "radiometry/band_radiance.h"

namespace thermal {

double ground_k(double u_px, double v_px) {
  constexpr double kShortest = 0.7853981633974483;  // a period of 8 px
  return 285 + 2 * std::sin(0.05 * u_px) * std::cos(0.03 * v_px) +
         std::sin(kShortest * (0.8 * u_px + 0.6 * v_px));
}

double scene_k(double u_px, double v_px) {
  const double across = std::fmod(u_px, 50);
  const double down = std::fmod(v_px, 50);
  return ground_k(u_px, v_px) + (across < 10 && down < 10 ? 10 : 0);
}

std::vector<double> scene_temperatures_k(double right_px) {
  std::vector<double> all_k;
  all_k.reserve(kScenePixels);
  for (int y = 0; y < kSceneHeightPx; ++y)
    for (int x = 0; x < kSceneWidthPx; ++x) all_k.push_back(scene_k(x + right_px + 0.5, y + 0.5));
  return all_k;
}

Plane<float> scene_radiance(const SpectralResponse& response) {
  const BandRadiance band(response);
  Plane<float> scene(kSceneWidthPx, kSceneHeightPx);
  std::ranges::transform(scene_temperatures_k(), scene.pixels().begin(),
                         [&](double kelvin) { return static_cast<float>(band.radiance(kelvin)); });
  return scene;
}

SensorParameters full_camera() {
  SensorParameters camera;
  camera.optics = {.psf = Psf::physical, .f_number = 1, .pixel_pitch_um = 12};
  camera.time_constant_s = 0.01;
  camera.noise = {.flicker_knee_hz = 0.5,
                  .fixed_pattern_ratio = 0.5,
                  .row_ratio = 0.1,
                  .column_ratio = 0.2,
                  .temporal_row_ratio = 0.05,
                  .temporal_column_ratio = 0.05,
                  .frame_ratio = 0.05,
                  .drift_ratio = 0.5};
  camera.shutter = {.interval_s = 180,
                    .freeze_s = 0};  // a frame with a closed shutter is cheap, and would be the shortest run
  camera.housing = {.excess_k = 10, .gain_error_share = 0.003, .halo_k = 0.1};
  camera.bad_pixels = {.dead_share = 1e-3, .blinking_share = 1e-4};
  camera.agc.mode = AgcMode::plateau;
  return camera;
}

ThermalCamera::Clip scene_clip() {
  return {.id = "bench",
          .frame_rate_hz = kSceneRateHz,
          .width_px = kSceneWidthPx,
          .height_px = kSceneHeightPx,
          .noise_gain = {}};
}

}  // namespace thermal
