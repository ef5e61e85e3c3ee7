#include "bench/detector_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rng.h"
#include "bench/sensor_scene.h"
#include "radiometry/band_radiance.h"
#include "sensor/housing.h"
#include "sensor/optics/optics.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr std::uint32_t kDetectorSeed = 1;

/// A camera that leaves the signal unchanged except for its outputs.
SensorParameters bare_camera() {
  SensorParameters camera;
  camera.optics.blur_sigma_px = 0;
  camera.noise.amount = 0;
  camera.agc.mode = AgcMode::linear;
  return camera;
}

/// Temperatures within a few kelvin of a mean, so that rounding to counts averages out.
Plane<float> spread_radiance(const BandRadiance& band, double middle_k) {
  Plane<float> plane(kSceneWidthPx, kSceneHeightPx);
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(plane.size());
    plane.pixels()[i] = static_cast<float>(band.radiance(middle_k + share));
  }
  return plane;
}

double mean_radiance(const BandRadiance& band, const SensorFrame& frame, double kelvin_per_count) {
  double sum = 0;
  for (const std::uint16_t count : frame.ir16.pixels()) sum += band.radiance(count * kelvin_per_count);
  return sum / static_cast<double>(frame.ir16.size());
}

double step_error() {
  constexpr int kFrames = 6;
  SensorParameters parameters = bare_camera();
  parameters.time_constant_s = 0.05;
  const BandRadiance band(parameters.response);
  const Plane<float> cold = spread_radiance(band, 240);
  const Plane<float> hot = spread_radiance(band, 340);
  const auto settled = [&](const Plane<float>& scene) {
    return mean_radiance(band, ThermalCamera(parameters, scene_clip(), 1).expose(scene),
                         parameters.kelvin_per_count);
  };
  const double before = settled(cold);
  const double after = settled(hot);
  ThermalCamera camera(parameters, scene_clip(), 1);
  SensorFrame frame = camera.expose(cold);
  double worst = 0;
  for (int n = 1; n <= kFrames; ++n) {
    camera.expose(hot, frame);
    const double seen = mean_radiance(band, frame, parameters.kelvin_per_count);
    const double exact = -std::expm1(-n / (kSceneRateHz * parameters.time_constant_s));
    worst = std::max(worst, std::abs((seen - before) / (after - before) - exact));
  }
  return worst;
}

double camera_ms(const SensorParameters& parameters, const Plane<float>& scene) {
  ThermalCamera camera(parameters, scene_clip(), 1);
  SensorFrame frame;
  return timed({}, 0, [&] { camera.expose(scene, frame); }).ms_per_frame;
}

StageRow lag_row() {
  StageRow row = {.group = "detector", .name = "thermal lag", .figures = {{"step_error", step_error()}}};
  SensorParameters parameters = bare_camera();
  const Plane<float> scene = scene_radiance(parameters.response);
  const double without_ms = camera_ms(parameters, scene);
  parameters.time_constant_s = 0.01;
  row.ms_per_frame = std::max(0.0, camera_ms(parameters, scene) - without_ms);
  return row;
}

RandomField white_field(std::uint32_t frame) {
  return {.seed = kDetectorSeed, .stream = kWhiteStream, .clip = hash_name("bench"), .frame = frame};
}

/// Mean square and mean fourth power of white noise, in their standard errors; for normal values these are sqrt(2 /
/// n) and sqrt(96 / n).
std::vector<Figure> white_moments() {
  constexpr std::uint32_t kFrames = 32;
  std::vector<float> values(kScenePixels);
  double squares = 0;
  double fourths = 0;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    fill_normal(white_field(frame), 0, values);
    for (const float value : values) {
      const double square = static_cast<double>(value) * static_cast<double>(value);
      squares += square;
      fourths += square * square;
    }
  }
  const double count = static_cast<double>(kScenePixels) * kFrames;
  return {{"variance_sigma", variance_sigma(squares / count, 1, count)},
          {"fourth_moment_sigma", (fourths / count - 3) / std::sqrt(96 / count)}};
}

/// Largest difference of a band's mean density from a flat spectrum, in standard errors: bins of a periodogram
/// scatter by as much as their mean, and a Hann window correlates 35/18 neighbours.
double worst_band_sigma() {
  constexpr std::size_t kPixels = 64;
  constexpr std::uint32_t kFrames = 4096;
  constexpr std::size_t kBands = 32;
  constexpr std::size_t kBins = kFrames / 2 / kBands;
  std::vector<std::vector<float>> series(kPixels, std::vector<float>(kFrames));
  std::array<float, kPixels> values{};
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    fill_normal(white_field(frame), 0, values);
    for (std::size_t i = 0; i < kPixels; ++i) series[i][frame] = values[i];
  }
  const std::vector<double> spectrum = mean_periodogram(series, kSceneRateHz);
  const double standard_error = std::sqrt(35.0 / 18 / (kPixels * kBins));
  double worst = 0;
  for (std::size_t band = 0; band < kBands; ++band) {
    double sum = 0;
    for (std::size_t k = std::max<std::size_t>(2, band * kBins); k < (band + 1) * kBins; ++k)
      sum += spectrum[k];
    const auto bins = static_cast<double>(band == 0 ? kBins - 2 : kBins);  // the window spoils the first two
    worst = std::max(worst, std::abs(sum / bins * kSceneRateHz / 2 - 1) / standard_error);
  }
  return worst;
}

StageRow white_row() {
  StageRow row = {.group = "detector", .name = "white noise", .figures = white_moments()};
  row.figures.push_back({"spectrum_worst_sigma", worst_band_sigma()});
  std::vector<float> out(kScenePixels);
  std::uint32_t frame = 0;
  return timed(row, 2 * sizeof(float), [&] {
    std::array<float, 256> normals{};
    for (std::size_t first = 0; first < out.size(); first += normals.size()) {
      fill_normal(white_field(frame), first, normals);
      add_scaled(normals, 0.02F, std::span(out).subspan(first, normals.size()));
    }
    ++frame;
  });
}

/// Variance of one component alone over this many pictures, each one interval after a closing of the shutter, in
/// standard errors. Pictures are small enough for the component's values to be independent.
double component_sigma(double NoiseParameters::*ratio, int width_px, int height_px, int pictures) {
  NoiseParameters parameters;
  parameters.*ratio = 1;
  PatternNoise noise(parameters, kDetectorSeed, "bench", width_px, height_px);
  const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  double squares = 0;
  for (std::uint32_t picture = 0; picture < static_cast<std::uint32_t>(pictures); ++picture) {
    std::vector<float> values(pixels);
    noise.begin_frame(picture, 0, {.event = picture, .since_intervals = 1});
    noise.add(0, 1, values);
    for (const float value : values) squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const double count = static_cast<double>(pixels) * pictures;
  return variance_sigma(squares / count, 1, count);
}

StageRow pattern_row() {
  using Noise = NoiseParameters;
  const StageRow row = {.group = "detector",
                        .name = "fixed pattern, rows, columns",
                        .figures = {{"vh_sigma", component_sigma(&Noise::fixed_pattern_ratio, 640, 512, 1)},
                                    {"drift_sigma", component_sigma(&Noise::drift_ratio, 640, 512, 1)},
                                    {"v_sigma", component_sigma(&Noise::row_ratio, 1, 512, 256)},
                                    {"h_sigma", component_sigma(&Noise::column_ratio, 640, 1, 256)},
                                    {"tv_sigma", component_sigma(&Noise::temporal_row_ratio, 1, 512, 256)},
                                    {"th_sigma", component_sigma(&Noise::temporal_column_ratio, 640, 1, 256)},
                                    {"t_sigma", component_sigma(&Noise::frame_ratio, 1, 1, 65536)}}};
  PatternNoise noise(full_camera().noise, kDetectorSeed, "bench", kSceneWidthPx, kSceneHeightPx);
  std::vector<float> out(kScenePixels);
  std::uint32_t frame = 0;
  return timed(row, 2 * sizeof(float), [&] {
    noise.begin_frame(frame, frame / kSceneRateHz, {.since_intervals = 0.5});
    ++frame;
    noise.add(0, 0.02F, out);
  });
}

/// Differences between neighbours have twice the variance of the half of the gain errors that is not smooth.
StageRow housing_row() {
  const HousingParameters parameters = full_camera().housing;
  Housing housing(parameters, 1, kDetectorSeed, "bench", kSceneWidthPx, kSceneHeightPx, 1, 1);
  std::vector<float> out(kScenePixels);
  housing.apply(0, out);  // a scene without radiance, a housing of 1
  double squares = 0;
  for (std::size_t i = 0; i < out.size(); i += 2)
    squares += std::pow(static_cast<double>(out[i]) - static_cast<double>(out[i + 1]), 2);
  const double pairs = 0.5 * kScenePixels;
  const double variance = std::pow(parameters.gain_error_share, 2);
  const StageRow row = {.group = "detector",
                        .name = "housing: gain, halo",
                        .figures = {{"gain_sigma", variance_sigma(squares / pairs, variance, pairs)}}};
  return timed(row, 2 * sizeof(float), [&] {
    housing.begin_frame({.since_intervals = 0.5});
    housing.apply(0, out);
  });
}

/// Temperatures are used as radiances, so that means of neighbours are in kelvin. Applied behind the optics, as in a
/// camera.
StageRow bad_pixel_row() {
  const SensorParameters camera = full_camera();
  Plane<float> truth(kSceneWidthPx, kSceneHeightPx);
  std::ranges::transform(scene_temperatures_k(), truth.pixels().begin(),
                         [](double kelvin) { return static_cast<float>(kelvin); });
  Optics(camera.optics, camera.response, {}).apply({}, truth);
  const BadPixelParameters parameters = camera.bad_pixels;
  BadPixels bad(parameters, kDetectorSeed, "bench", kSceneRateHz, kSceneWidthPx, kSceneHeightPx);
  Plane<float> shown = truth;
  bad.apply(0, 0, shown);
  double squares_k2 = 0;
  for (const std::size_t pixel : bad.dead()) {
    squares_k2 += std::pow(static_cast<double>(shown.pixels()[pixel] - truth.pixels()[pixel]), 2);
  }
  const auto dead = static_cast<double>(bad.dead().size());
  const double wanted = parameters.dead_share * static_cast<double>(kScenePixels);
  const StageRow row = {.group = "detector",
                        .name = "bad pixels, 1 in 1000 dead",
                        .figures = {{"count_sigma", (dead - wanted) / std::sqrt(wanted)},
                                    {"replaced_rms_mk", 1e3 * std::sqrt(squares_k2 / dead)}}};
  std::uint32_t frame = 1;
  return timed(row, 0, [&] { bad.apply(frame++, 0, shown); });
}

}  // namespace

std::vector<StageRow> detector_rows() {
  return {lag_row(), white_row(), pattern_row(), housing_row(), bad_pixel_row()};
}

}  // namespace thermal
