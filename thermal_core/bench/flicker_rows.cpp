#include "bench/flicker_rows.h"

#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "bench/ou_bank.h"
#include "bench/sensor_scene.h"
#include "bench/spectrum.h"
#include "sensor/flicker_noise.h"

namespace thermal {
namespace {

constexpr double kLowHz = 0.01;
constexpr double kHighHz = 10;
constexpr std::uint32_t kFlickerSeed = 1;

using AddNext = std::function<void(std::uint32_t frame, std::span<float> out)>;

/// A generator of 1/f noise.
struct Generator {
  std::string name;
  Density density;
  double variance = 0;
  std::function<AddNext(std::size_t pixels)> start;
};

Generator pole_zero(double poles_per_decade) {
  const FlickerFilter filter = FlickerFilter::design(kSceneRateHz, poles_per_decade);
  return {.name = fmt::format("pole-zero, {} per decade, {} poles", poles_per_decade, filter.poles.size()),
          .density = [filter](double f_hz) { return filter.density(f_hz, kSceneRateHz); },
          .variance = filter.variance(),
          .start = [filter](std::size_t pixels) -> AddNext {
            const auto noise = std::make_shared<FlickerNoise>(kFlickerSeed, "bench", filter, pixels);
            return [noise](std::uint32_t frame, std::span<float> out) { noise->add_next(frame, 0, 1, out); };
          }};
}

Generator ou_processes(int count) {
  const OuBank bank = OuBank::design(kSceneRateHz, count);
  return {.name = fmt::format("{} Ornstein-Uhlenbeck processes", count),
          .density = [bank](double f_hz) { return bank.density(f_hz, kSceneRateHz); },
          .variance = bank.variance(),
          .start = [bank](std::size_t pixels) -> AddNext {
            const auto noise = std::make_shared<OuNoise>(kFlickerSeed, "bench", bank, pixels);
            return [noise](std::uint32_t frame, std::span<float> out) { noise->add_next(frame, out); };
          }};
}

/// Slope error of the measured spectrum, in bands of an eighth of a decade.
double measured_slope_error(const Generator& generator) {
  constexpr std::size_t kSlopePixels = 128;
  constexpr std::uint32_t kFrames = 32768;
  constexpr int kBands = 24;
  std::vector<std::vector<float>> series(kSlopePixels, std::vector<float>(kFrames));
  const AddNext add_next = generator.start(kSlopePixels);
  std::vector<float> values(kSlopePixels);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    std::fill(values.begin(), values.end(), 0.0F);
    add_next(frame, values);
    for (std::size_t i = 0; i < kSlopePixels; ++i) series[i][frame] = values[i];
  }
  const std::vector<double> spectrum = mean_periodogram(series, kSceneRateHz);
  const double bin_hz = kSceneRateHz / kFrames;
  const double half_band = std::pow(kHighHz / kLowHz, 0.5 / kBands);
  const auto band_mean = [&](double frequency_hz) {  // of f S, which is nearly constant within a band
    double sum = 0;
    int count = 0;
    const auto last = static_cast<std::size_t>(frequency_hz * half_band / bin_hz);
    for (auto k = static_cast<std::size_t>(frequency_hz / half_band / bin_hz) + 1; k <= last; ++k, ++count) {
      sum += static_cast<double>(k) * bin_hz * spectrum[k];
    }
    return sum / count / frequency_hz;
  };
  return fit_flicker(band_mean, kLowHz, kHighHz, kBands).slope_error;
}

double frame_variance_sigma(const Generator& generator) {
  const AddNext add_next = generator.start(kScenePixels);
  std::vector<float> values(kScenePixels);
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    std::fill(values.begin(), values.end(), 0.0F);
    add_next(frame, values);
  }
  double squares = 0;
  for (const float value : values) squares += static_cast<double>(value) * static_cast<double>(value);
  const auto count = static_cast<double>(kScenePixels);
  return variance_sigma(squares / count, generator.variance, count);
}

StageRow row_of(const Generator& generator) {
  const FlickerFit fit = fit_flicker(generator.density, kLowHz, kHighHz, 600);
  const StageRow row = {.group = "1/f noise",
                        .name = generator.name,
                        .figures = {{"slope_error", fit.slope_error},
                                    {"ripple_db", fit.ripple_db},
                                    {"measured_slope_error", measured_slope_error(generator)},
                                    {"variance_sigma", frame_variance_sigma(generator)}}};
  const AddNext add_next = generator.start(kScenePixels);
  std::vector<float> out(kScenePixels);
  std::uint32_t frame = 0;
  return timed(row, 2 * sizeof(float), [&] { add_next(frame++, out); });
}

}  // namespace

std::vector<StageRow> flicker_rows() {
  std::vector<StageRow> rows;
  for (const double poles_per_decade : {0.5, 1.0, 2.0, 3.0})
    rows.push_back(row_of(pole_zero(poles_per_decade)));
  for (const int processes : {3, 5, 8}) rows.push_back(row_of(ou_processes(processes)));
  return rows;
}

}  // namespace thermal
