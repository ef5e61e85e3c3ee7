#include "bench/sensor_scene.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "bench/measure.h"
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

StageRow timed(StageRow row, std::size_t bytes_per_pixel, const std::function<void()>& frame) {
  constexpr double kStageBudgetS = 0.2;
  constexpr double kMemcpyBudgetS = 0.05;  // tenths of a millisecond each
  const double seconds = shortest_run_s(frame, kStageBudgetS);
  row.ms_per_frame = 1e3 * seconds;
  if (bytes_per_pixel > 0)
    row.times_memcpy = seconds / memcpy_s(bytes_per_pixel * kScenePixels, kMemcpyBudgetS);
  return row;
}

double variance_sigma(double mean_square, double variance, double count) {
  return (mean_square / variance - 1) / std::sqrt(2 / count);
}

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// Discrete Fourier transform in place, radix 2.
void transform(std::vector<Complex>& values) {
  const std::size_t length = values.size();
  for (std::size_t i = 1, j = 0; i < length; ++i) {  // into bit-reversed order
    std::size_t bit = length / 2;
    for (; (j & bit) != 0; bit /= 2) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  std::vector<Complex> turns(length / 2);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    turns[i] = std::polar(1.0, -2 * pi * static_cast<double>(i) / static_cast<double>(length));
  }
  for (std::size_t half = 1; half < length; half *= 2) {
    for (std::size_t begin = 0; begin < length; begin += 2 * half) {
      for (std::size_t i = 0; i < half; ++i) {
        const Complex odd = values[begin + half + i] * turns[i * (length / (2 * half))];
        values[begin + half + i] = values[begin + i] - odd;
        values[begin + i] += odd;
      }
    }
  }
}

}  // namespace

std::vector<double> mean_periodogram(const std::vector<std::vector<float>>& series, double rate_hz) {
  const std::size_t length = series.front().size();
  assert(std::has_single_bit(length));
  std::vector<double> mean(length / 2);
  std::vector<Complex> values(length);
  for (const std::vector<float>& one : series) {
    for (std::size_t i = 0; i < length; ++i) {
      const double turns = static_cast<double>(i) / static_cast<double>(length);
      values[i] = static_cast<double>(one[i]) * (0.5 - 0.5 * std::cos(2 * pi * turns));
    }
    transform(values);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += std::norm(values[k]);
  }
  constexpr double kWindowPower = 3.0 / 8;  // mean square of the Hann window
  const double scale =
      2 / (rate_hz * kWindowPower * static_cast<double>(length) * static_cast<double>(series.size()));
  for (double& value : mean) value *= scale;
  return mean;
}

}  // namespace thermal
