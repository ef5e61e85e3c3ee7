#include "bench/tone_rows.h"

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "bench/sensor_scene.h"
#include "sensor/detail.h"
#include "sensor/temporal_filter.h"

namespace thermal {
namespace {

constexpr double kShare = 0.5;

Plane<float> noise_frame(std::uint32_t number) {
  Plane<float> signal(kSceneWidthPx, kSceneHeightPx);
  fill_normal({.seed = 1, .stream = 1, .clip = 1, .frame = number}, 0, signal.pixels());
  for (float& value : signal.pixels()) value += 100;
  return signal;
}

double kept_variance(TemporalFilter& filter) {
  constexpr std::uint32_t kFrames = 40;  // the first frame's weight is 2^-39 by then
  Plane<float> signal;
  for (std::uint32_t number = 0; number < kFrames; ++number) {
    signal = noise_frame(number);
    filter.apply(signal);
  }
  double sum = 0;
  for (const float value : signal.pixels())
    sum += (static_cast<double>(value) - 100) * (static_cast<double>(value) - 100);
  return sum / static_cast<double>(signal.size());
}

StageRow denoise_row() {
  TemporalFilter filter({.share_of_new = kShare}, 1);
  const double wanted = kShare / (2 - kShare);
  const StageRow row = {.group = "noise reduction",
                        .name = "recursive mean, share 0.5",
                        .figures = {{"variance_off_percent", 100 * (kept_variance(filter) / wanted - 1)}}};
  Plane<float> signal = noise_frame(0);
  return timed(row, 3 * sizeof(float), [&] { filter.apply(signal); });
}

/// The scene in counts of 10 mK.
Plane<std::uint16_t> scene_counts() {
  Plane<std::uint16_t> ir16(kSceneWidthPx, kSceneHeightPx);
  std::ranges::transform(scene_temperatures_k(), ir16.pixels().begin(),
                         [](double kelvin) { return static_cast<std::uint16_t>(std::lround(100 * kelvin)); });
  return ir16;
}

/// The guided filter's model of one window, in double precision.
struct Model {
  double gain;
  double offset;
};

Model model_at(const Plane<std::uint16_t>& ir16, int x, int y, int radius, double edge_counts) {
  const int pixels = (2 * radius + 1) * (2 * radius + 1);
  double mean = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) mean += ir16.at(x + dx, y + dy);
  mean /= pixels;
  double variance = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) variance += std::pow(ir16.at(x + dx, y + dy) - mean, 2);
  variance /= pixels;
  const double gain = variance / (variance + edge_counts * edge_counts);
  return {.gain = gain, .offset = mean * (1 - gain)};
}

double worst_detail_counts(const Plane<std::uint16_t>& ir16, int radius, double edge_counts) {
  Plane<float> detail;
  find_detail(ir16, radius, edge_counts, detail);
  const int pixels = (2 * radius + 1) * (2 * radius + 1);
  double worst = 0;
  for (int y = 2 * radius; y < kSceneHeightPx - 2 * radius; y += 23) {
    for (int x = 2 * radius; x < kSceneWidthPx - 2 * radius; x += 23) {
      double base = 0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
          const Model model = model_at(ir16, x + dx, y + dy, radius, edge_counts);
          base += (model.gain * ir16.at(x, y) + model.offset) / pixels;
        }
      worst = std::max(worst, std::abs(ir16.at(x, y) - base - static_cast<double>(detail.at(x, y))));
    }
  }
  return worst;
}

StageRow detail_row() {
  constexpr double kCountsPerNetd = 4;
  const DetailParameters parameters = {.gain_dn_per_netd = 4};
  const Plane<std::uint16_t> ir16 = scene_counts();
  const double worst = worst_detail_counts(ir16, parameters.radius_px, parameters.edge_netd * kCountsPerNetd);
  const StageRow row = {
      .group = "sharpening", .name = "detail, radius 3 px", .figures = {{"worst_counts", worst}}};
  DetailEnhancer enhancer({.detail = parameters}, kCountsPerNetd);
  Plane<std::uint8_t> ir8(kSceneWidthPx, kSceneHeightPx, 128);
  return timed(row, sizeof(std::uint16_t) + 2 * sizeof(std::uint8_t), [&] { enhancer.sharpen(ir16, ir8); });
}

}  // namespace

std::vector<StageRow> tone_rows() { return {denoise_row(), detail_row()}; }

}  // namespace thermal
