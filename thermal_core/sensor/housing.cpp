#include "sensor/housing.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/clones.h"
#include "base/rng.h"
#include "sensor/streams.h"

namespace thermal {
namespace {

constexpr int kWaves = 4;  // along each axis, of the smooth gain error: 0 to 1.5 periods in the frame
const double kHalf = std::sqrt(0.5);

VELDT_CLONES void apply_gain(const float* errors, std::size_t count, float housing, float* signal) {
  for (std::size_t i = 0; i < count; ++i) signal[i] += errors[i] * (signal[i] - housing);
}

VELDT_CLONES void add_halo(const float* columns, std::size_t count, float row, float* signal) {
  for (std::size_t i = 0; i < count; ++i) signal[i] += row + columns[i];
}

/// Half a wave more along the axis for each k; mean square 1 over whole axes.
std::vector<double> cosine(int k, int size) {
  std::vector<double> values;
  for (int i = 0; i < size; ++i)
    values.push_back(k == 0 ? 1 : std::numbers::sqrt2 * std::cos(std::numbers::pi * k * (i + 0.5) / size));
  return values;
}

/// Squared distance of pixels from the middle along an axis, as a share of that of the picture's corners.
std::vector<double> squared_distances(int size, double corner2) {
  std::vector<double> values;
  for (int i = 0; i < size; ++i) {
    const double away = i + 0.5 - 0.5 * size;
    values.push_back(away * away / corner2);
  }
  return values;
}

std::vector<float> scaled(const std::vector<double>& values, double factor) {
  std::vector<float> result;
  for (const double value : values) result.push_back(static_cast<float>(factor * value));
  return result;
}

}  // namespace

Housing::Housing(const HousingParameters& parameters, double amount, std::uint32_t seed,
                 std::string_view clip, int width_px, int height_px, double housing_w_m2_sr,
                 double w_m2_sr_per_k)
    : gain_error_(amount * parameters.gain_error_share),
      halo_w_m2_sr_(amount * parameters.halo_k * w_m2_sr_per_k),
      seed_(seed),
      clip_(hash_name(clip)),
      housing_w_m2_sr_(housing_w_m2_sr) {
  const double corner2 = 0.25 * (std::pow(width_px, 2) + std::pow(height_px, 2));
  columns_ = squared_distances(width_px, corner2);
  rows_ = squared_distances(height_px, corner2);
  if (gain_error_ > 0) draw_gain(width_px, height_px);
}

void Housing::draw_gain(int width_px, int height_px) {
  RandomField field = {.seed = seed_, .stream = kGainWaveStream, .clip = clip_, .frame = 0};
  std::array<float, std::size_t{kWaves} * kWaves> sizes{};
  fill_normal(field, 0, sizes);
  field.stream = kGainPixelStream;
  gain_errors_.resize(columns_.size() * rows_.size());
  fill_normal(field, 0, gain_errors_);
  for (float& error : gain_errors_) error *= static_cast<float>(gain_error_ * kHalf);
  const double wave = gain_error_ * kHalf / std::sqrt(kWaves * kWaves - 1.0);
  for (int k = 1; k < kWaves * kWaves; ++k) {  // 0 is the mean, which calibration removes
    const std::vector<float> across = scaled(cosine(k % kWaves, width_px), 1);
    const std::vector<double> down = cosine(k / kWaves, height_px);
    for (std::size_t y = 0; y < down.size(); ++y) {
      const auto size =
          static_cast<float>(wave * static_cast<double>(sizes[static_cast<std::size_t>(k)]) * down[y]);
      for (std::size_t x = 0; x < across.size(); ++x) gain_errors_[y * across.size() + x] += size * across[x];
    }
  }
}

void Housing::begin_frame(const ShutterState& shutter) {
  if (halo_w_m2_sr_ == 0) return;
  float size = 0;
  fill_normal({.seed = seed_, .stream = kHaloStream, .clip = clip_, .frame = shutter.event}, 0,
              std::span(&size, 1));
  const double corner = halo_w_m2_sr_ * static_cast<double>(size) * shutter.growth();
  row_halo_ = scaled(rows_, corner);
  column_halo_ = scaled(columns_, corner);
}

void Housing::apply(std::size_t first, std::span<float> signal) const {
  if (!gain_errors_.empty())
    apply_gain(&gain_errors_[first], signal.size(), static_cast<float>(housing_w_m2_sr_), signal.data());
  if (row_halo_.empty()) return;
  const std::size_t width = columns_.size();
  for (std::size_t done = 0; done < signal.size();) {
    const std::size_t column = (first + done) % width;
    const std::size_t count = std::min(width - column, signal.size() - done);
    add_halo(&column_halo_[column], count, row_halo_[(first + done) / width], &signal[done]);
    done += count;
  }
}

double Housing::pixel_stddev_w_m2_sr(double scene_w_m2_sr) const noexcept {
  return gain_error_ * kHalf * std::abs(scene_w_m2_sr - housing_w_m2_sr_);
}

}  // namespace thermal
