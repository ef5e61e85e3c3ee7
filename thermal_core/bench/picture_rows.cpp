#include "bench/picture_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/reference_agc.h"
#include "bench/sensor_scene.h"
#include "radiometry/band_radiance.h"
#include "radiometry/radiance_table.h"
#include "sensor/optics/psf.h"
#include "sensor/optics/round_kernel.h"

namespace thermal {
namespace {

constexpr std::size_t kBytesInAndOut = sizeof(float) + sizeof(std::uint16_t) + sizeof(std::uint8_t);
constexpr int kEveryPx = 7;  // pixels apart: the double-precision reference takes microseconds each

StageRow table_row() {
  const BandRadiance band(SensorParameters().response);
  const TemperatureTable table([&band](double radiance) { return band.temperature(radiance); },
                               band.radiance(180), band.radiance(420));
  const Plane<float> scene = scene_radiance(SensorParameters().response);
  Plane<float> temperatures_k(kSceneWidthPx, kSceneHeightPx);
  table.temperatures(scene.pixels(), temperatures_k.pixels());
  double worst_k = 0;
  for (std::size_t i = 0; i < scene.size(); i += kEveryPx * kEveryPx) {
    const double exact_k = band.temperature(static_cast<double>(scene.pixels()[i]));
    worst_k = std::max(worst_k, std::abs(static_cast<double>(temperatures_k.pixels()[i]) - exact_k));
  }
  const StageRow row = {
      .group = "16-bit", .name = "apparent temperature, table", .figures = {{"worst_mk", 1e3 * worst_k}}};
  return timed(row, 2 * sizeof(float), [&] { table.temperatures(scene.pixels(), temperatures_k.pixels()); });
}

/// The scene's temperatures with a constant added.
std::vector<double> temperatures(double warmer_k) {
  std::vector<double> all_k = scene_temperatures_k();
  for (double& kelvin : all_k) kelvin += warmer_k;
  return all_k;
}

Plane<std::uint16_t> counts_of(const std::vector<double>& temperatures_k, double kelvin_per_count) {
  Plane<std::uint16_t> ir16(kSceneWidthPx, kSceneHeightPx);
  for (std::size_t i = 0; i < ir16.size(); ++i) {
    ir16.pixels()[i] = static_cast<std::uint16_t>(std::lround(temperatures_k[i] / kelvin_per_count));
  }
  return ir16;
}

/// Differences of an AGC's pictures from the reference's in the second of two frames, the warmer one.
template <typename Reference>
std::vector<Figure> agc_figures(const AgcParameters& parameters, const AgcScene& scene) {
  Reference reference(parameters, scene);
  Agc agc(parameters, scene);
  std::vector<int> exact;
  Plane<std::uint8_t> ir8;
  for (const double warmer_k : {0.0, 3.0}) {
    const std::vector<double> temperatures_k = temperatures(warmer_k);
    const Plane<std::uint16_t> ir16 = counts_of(temperatures_k, scene.kelvin_per_count);
    exact = reference.next(temperatures_k);
    (void)agc.next(ir16);
    agc.show(ir16, ir8);
  }
  int worst = 0;
  std::size_t off = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const int difference = std::abs(exact[i] - ir8.pixels()[i]);
    worst = std::max(worst, difference);
    if (difference > 0) ++off;
  }
  return {{"off_percent", 100 * static_cast<double>(off) / static_cast<double>(exact.size())},
          {"worst_levels", static_cast<double>(worst)}};
}

StageRow agc_row(const std::string& name, AgcMode mode) {
  constexpr double kBrightestK = 320;
  const BandRadiance band(SensorParameters().response);
  const AgcParameters parameters = {.mode = mode};
  const AgcScene scene = {.frame_rate_hz = kSceneRateHz,
                          .brightest_w_m2_sr = band.radiance(kBrightestK),
                          .temperature_of = [band](double radiance) { return band.temperature(radiance); }};
  const StageRow row = {.group = "AGC",
                        .name = name,
                        .figures = mode == AgcMode::clahe ? agc_figures<ReferenceClahe>(parameters, scene)
                                                          : agc_figures<ReferenceAgc>(parameters, scene)};
  Agc agc(parameters, scene);
  const Plane<std::uint16_t> ir16 = counts_of(temperatures(0), scene.kelvin_per_count);
  Plane<std::uint8_t> ir8;
  return timed(row, sizeof(std::uint16_t) + sizeof(std::uint8_t), [&] {
    (void)agc.next(ir16);
    agc.show(ir16, ir8);
  });
}

/// Effect of headroom on levels, against the definition.
StageRow headroom_row() {
  const AgcParameters full = {.mode = AgcMode::plateau};
  AgcParameters narrow = full;
  narrow.black_level = 12;
  narrow.white_level = 244;
  const AgcScene scene = {.frame_rate_hz = kSceneRateHz, .temperature_of = {}};
  const Plane<std::uint16_t> ir16 = counts_of(temperatures(0), scene.kelvin_per_count);
  Plane<std::uint8_t> levels;
  Plane<std::uint8_t> ir8;
  Agc reference(full, scene);
  Agc agc(narrow, scene);
  (void)reference.next(ir16);
  reference.show(ir16, levels);
  const auto frame = [&] {
    (void)agc.next(ir16);
    agc.show(ir16, ir8);
  };
  frame();
  int worst = 0;
  for (std::size_t i = 0; i < ir8.size(); ++i)
    worst = std::max(worst, std::abs(level_within(levels.pixels()[i], 12, 244) - ir8.pixels()[i]));
  const StageRow row = {.group = "AGC",
                        .name = "plateau, levels 12 to 244",
                        .figures = {{"worst_levels", static_cast<double>(worst)}}};
  return timed(row, sizeof(std::uint16_t) + sizeof(std::uint8_t), frame);
}

/// The pixel under the whole kernel, in double precision. It must be far enough from the border.
double blurred(const Plane<float>& scene, const HalfKernel& kernel, int x, int y) {
  const int radius = static_cast<int>(kernel.size()) - 1;
  double sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const double across = static_cast<double>(kernel[static_cast<std::size_t>(std::abs(dx))]);
      const double down = static_cast<double>(kernel[static_cast<std::size_t>(std::abs(dy))]);
      sum += across * down * static_cast<double>(scene.at(x + dx, y + dy));
    }
  }
  return sum;
}

/// The same of a round kernel, whose halo is interpolated between the means of blocks.
double blurred(const Plane<float>& scene, const RoundKernel& kernel, int x, int y) {
  const auto sum_around = [](const QuadrantKernel& weights, const auto& value) {
    double sum = 0;
    for (int dy = -weights.radius; dy <= weights.radius; ++dy) {
      for (int dx = -weights.radius; dx <= weights.radius; ++dx)
        sum += static_cast<double>(weights.at(std::abs(dx), std::abs(dy))) * value(dx, dy);
    }
    return sum;
  };
  const auto block = [&scene](int column, int row) {
    double sum = 0;
    for (int i = 0; i < kHaloBlockPx * kHaloBlockPx; ++i)
      sum += static_cast<double>(
          scene.at(kHaloBlockPx * column + i % kHaloBlockPx, kHaloBlockPx * row + i / kHaloBlockPx));
    return sum / (kHaloBlockPx * kHaloBlockPx);
  };
  const double column = (x + 0.5) / kHaloBlockPx - 0.5;
  const double row = (y + 0.5) / kHaloBlockPx - 0.5;
  double halo = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int at_column = static_cast<int>(column) + corner % 2;
    const int at_row = static_cast<int>(row) + corner / 2;
    const double share = (1 - std::abs(column - at_column)) * (1 - std::abs(row - at_row));
    halo +=
        share * sum_around(kernel.halo, [&](int dx, int dy) { return block(at_column + dx, at_row + dy); });
  }
  return halo + sum_around(kernel.pixel,
                           [&](int dx, int dy) { return static_cast<double>(scene.at(x + dx, y + dy)); });
}

/// The camera's optics at a pixel of this scene, in double precision.
std::function<double(int x, int y)> reference_blur(const SensorParameters& parameters,
                                                   const Plane<float>& scene) {
  const OpticsParameters& optics = parameters.optics;
  if (optics.psf == Psf::gaussian) {
    return [&scene, kernel = gaussian_psf(optics.blur_sigma_px)](int x, int y) {
      return blurred(scene, kernel, x, y);
    };
  }
  return [&scene, kernel = round_kernel(optics, parameters.response, {})](int x, int y) {
    return blurred(scene, kernel, x, y);
  };
}

double worst_counts(SensorParameters parameters) {
  constexpr int kBorderPx = 32;
  parameters.noise.amount = 0;
  parameters.bad_pixels = {};
  const BandRadiance band(parameters.response);
  const Plane<float> scene = scene_radiance(parameters.response);
  const SensorFrame frame = ThermalCamera(parameters, scene_clip(), 1).expose(scene);
  const auto blurred_at = reference_blur(parameters, scene);
  double worst = 0;
  for (int y = kBorderPx; y < kSceneHeightPx - kBorderPx; y += kEveryPx) {
    for (int x = kBorderPx; x < kSceneWidthPx - kBorderPx; x += kEveryPx) {
      const double exact = band.temperature(blurred_at(x, y)) / parameters.kelvin_per_count;
      worst = std::max(worst, std::abs(frame.ir16.at(x, y) - exact));
    }
  }
  return worst;
}

StageRow camera_row(const std::string& name, const SensorParameters& parameters) {
  const StageRow row = {
      .group = "whole camera", .name = name, .figures = {{"worst_counts", worst_counts(parameters)}}};
  const BandRadiance band(parameters.response);
  const Plane<float> scene = scene_radiance(parameters.response);
  ThermalCamera camera(parameters, scene_clip(), static_cast<float>(band.radiance(310)));
  SensorFrame frame;
  return timed(row, kBytesInAndOut, [&] { camera.expose(scene, frame); });
}

}  // namespace

std::vector<StageRow> picture_rows() {
  SensorParameters published;
  published.noise = {.flicker_knee_hz = 0.5, .first_frame_ratio = 0.1};
  SensorParameters outputs = published;
  outputs.optics.blur_sigma_px = 0;
  outputs.noise.amount = 0;
  return {table_row(),
          agc_row("scene_max", AgcMode::scene_max),
          agc_row("table_max", AgcMode::table_max),
          agc_row("linear", AgcMode::linear),
          agc_row("percentile", AgcMode::percentile),
          agc_row("plateau", AgcMode::plateau),
          agc_row("information", AgcMode::information),
          agc_row("clahe", AgcMode::clahe),
          headroom_row(),
          camera_row("both outputs alone", outputs),
          camera_row("as published: blur, white, 1/f", published),
          camera_row("every stage", full_camera())};
}

}  // namespace thermal
