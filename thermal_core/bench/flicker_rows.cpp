#include "bench/flicker_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "base/rng.h"
#include "bench/sensor_scene.h"
#include "sensor/flicker_noise.h"
#include "sensor/streams.h"
#include "sensor/thermal_camera.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

constexpr double kKneeHz = 0.5;
constexpr double kLowHz = 0.01;
constexpr double kHighHz = 10;
constexpr double kHighOfNyquist = 0.8;
constexpr std::uint32_t kFlickerSeed = 1;
constexpr std::size_t kWhiteBlock = 256;

using AddNext = std::function<void(std::uint32_t frame, std::span<float> out)>;

/// A generator of white and 1/f noise.
struct Generator {
  std::string name;
  double video_rate_hz = 0;
  double native_rate_hz = 0;
  Density over_white;  ///< native density / that of white noise of variance 1
  double variance = 0;
  std::function<AddNext(std::size_t pixels)> start;
};

void add_white(std::uint32_t frame, double variance, std::span<float> out) {
  std::array<float, kWhiteBlock> buffer{};
  for (std::size_t first = 0; first < out.size(); first += kWhiteBlock) {
    const std::span<float> normals = std::span(buffer).first(std::min(kWhiteBlock, out.size() - first));
    fill_normal({.seed = kFlickerSeed, .stream = kWhiteStream, .clip = 0, .frame = frame}, first, normals);
    add_scaled(normals, static_cast<float>(std::sqrt(variance)), out.subspan(first, normals.size()));
  }
}

Generator ticking(double native_rate_hz, double video_rate_hz) {
  const NativeRate native = NativeRate::of(native_rate_hz, video_rate_hz);
  const FlickerDesign design = FlickerDesign::fit(native.rate_hz, kKneeHz);
  return {.name = fmt::format("{} processes, {} of {} Hz", design.processes.size(), video_rate_hz,
                              native.rate_hz),
          .video_rate_hz = video_rate_hz,
          .native_rate_hz = native.rate_hz,
          .over_white =
              [design, native](double f_hz) {
                return 1 + kKneeHz * design.density(f_hz, native.rate_hz) * native.rate_hz / 2;
              },
          .variance = 1 + kKneeHz * design.variance(),
          .start = [design, native](std::size_t pixels) -> AddNext {
            const auto noise = std::make_shared<FlickerNoise>(kFlickerSeed, "bench", design, pixels);
            return [noise, native, white = 1 + kKneeHz * design.white_variance](std::uint32_t frame,
                                                                                std::span<float> out) {
              add_white(frame * native.step, white, out);
              noise->add(frame * native.step, 0, static_cast<float>(std::sqrt(kKneeHz)), out);
            };
          }};
}

double worst_db(const Generator& generator) {
  constexpr int kPoints = 600;
  constexpr double kFromHz = 3e-3;
  double worst = 0;
  for (int k = 0; k < kPoints; ++k) {
    const double hz = kFromHz * std::pow(0.5 * generator.native_rate_hz / kFromHz, (k + 0.5) / kPoints);
    worst = std::max(worst, std::abs(10 * std::log10(generator.over_white(hz) / (1 + kKneeHz / hz))));
  }
  return worst;
}

/// The deviation in a video. Its spectrum aliases as by theory, so only videos with every native frame are measured.
double measured_db(const Generator& generator) {
  constexpr std::size_t kSpectrumPixels = 128;
  constexpr std::uint32_t kFrames = 32768;
  constexpr double kBand = 0.125;  // of a decade
  std::vector<std::vector<float>> series(kSpectrumPixels, std::vector<float>(kFrames));
  const AddNext add_next = generator.start(kSpectrumPixels);
  std::vector<float> values(kSpectrumPixels);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    std::ranges::fill(values, 0.0F);
    add_next(frame, values);
    for (std::size_t i = 0; i < kSpectrumPixels; ++i) series[i][frame] = values[i];
  }
  const double rate_hz = generator.video_rate_hz;
  const std::vector<double> spectrum = mean_periodogram(series, rate_hz);
  const double bin_hz = rate_hz / kFrames;
  double worst = 0;
  for (double hz = kLowHz; hz < std::min(kHighHz, 0.5 * kHighOfNyquist * rate_hz);
       hz *= std::pow(10, kBand)) {
    double ratio = 0;
    int count = 0;
    for (auto k = static_cast<std::size_t>(hz / bin_hz) + 1;
         static_cast<double>(k) * bin_hz < hz * std::pow(10, kBand); ++k, ++count)
      ratio += spectrum[k] * rate_hz / 2 / (1 + kKneeHz / (static_cast<double>(k) * bin_hz));
    worst = std::max(worst, std::abs(10 * std::log10(ratio / count)));
  }
  return worst;
}

double frame_variance_sigma(const Generator& generator) {
  const AddNext add_next = generator.start(kScenePixels);
  std::vector<float> values(kScenePixels);
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    std::ranges::fill(values, 0.0F);
    add_next(frame, values);
  }
  double squares = 0;
  for (const float value : values) squares += static_cast<double>(value) * static_cast<double>(value);
  const auto count = static_cast<double>(kScenePixels);
  return variance_sigma(squares / count, generator.variance, count);
}

StageRow row_of(const Generator& generator) {
  StageRow row = {
      .group = "white and 1/f noise", .name = generator.name, .figures = {{"worst_db", worst_db(generator)}}};
  if (generator.video_rate_hz == generator.native_rate_hz)
    row.figures.push_back({"measured_db", measured_db(generator)});
  row.figures.push_back({"variance_sigma", frame_variance_sigma(generator)});
  const AddNext add_next = generator.start(kScenePixels);
  std::vector<float> out(kScenePixels);
  std::uint32_t frame = 0;
  return timed(row, 2 * sizeof(float), [&] { add_next(frame++, out); });
}

}  // namespace

std::vector<StageRow> flicker_rows() {
  std::vector<StageRow> rows;
  for (const double native_rate_hz : {60.0, 30.0, 9.0})
    rows.push_back(row_of(ticking(native_rate_hz, native_rate_hz)));
  for (const double video_rate_hz : {30.0, 9.0}) rows.push_back(row_of(ticking(60, video_rate_hz)));
  return rows;
}

}  // namespace thermal
