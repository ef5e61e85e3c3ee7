#include "sensor/pattern_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/clones.h"
#include "sensor/streams.h"
#include "sensor/vector_math.h"

namespace thermal {
namespace {

VELDT_CLONES void add_row(const float* columns, std::size_t count, float row, float stddev, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += stddev * (row + columns[i]);
}

/// Both patterns in one pass, which memory limits.
VELDT_CLONES void add_two(const float* fixed, float fixed_stddev, const float* drift, float drift_stddev,
                          std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = out[i] + fixed_stddev * fixed[i] + drift_stddev * drift[i];
}

}  // namespace

PatternNoise::PatternNoise(const NoiseParameters& parameters, std::uint32_t seed, std::string_view clip,
                           int width_px, int height_px)
    : parameters_(parameters),
      seed_(seed),
      clip_(hash_name(clip)),
      width_px_(width_px),
      height_px_(height_px) {
  float phase = 0;
  fill_uniform(field(kBandingPhaseStream, 0), 0, std::span(&phase, 1));
  banding_phase_ = static_cast<double>(phase);
}

RandomField PatternNoise::field(std::uint32_t stream, std::uint32_t frame) const noexcept {
  return {.seed = seed_, .stream = stream, .clip = clip_, .frame = frame};
}

void PatternNoise::draw_fixed(std::uint32_t event) {
  const int pixels = width_px_ * height_px_;
  const NoiseParameters& ratios = parameters_;
  if (ratios.drift_ratio > 0) drift_ = normal_values(field(kDriftStream, event), pixels);
  if (ratios.fixed_pattern_ratio == 0 && ratios.row_ratio == 0 && ratios.column_ratio == 0) return;
  fixed_ = normal_values(field(kFixedPatternStream, event), pixels);
  for (float& value : fixed_) value *= static_cast<float>(ratios.fixed_pattern_ratio);
  std::vector<float> columns = normal_values(field(kFixedColumnStream, event), width_px_);
  for (float& value : columns) value *= static_cast<float>(ratios.column_ratio);
  const std::vector<float> rows = normal_values(field(kFixedRowStream, event), height_px_);
  for (std::size_t y = 0; y < rows.size(); ++y) {
    add_row(columns.data(), columns.size(), static_cast<float>(ratios.row_ratio) * rows[y], 1,
            &fixed_[y * columns.size()]);
  }
}

void PatternNoise::begin_frame(std::uint32_t frame, double time_s, const ShutterState& shutter) {
  if (event_ != shutter.event) draw_fixed(shutter.event);
  event_ = shutter.event;
  drifted_ = static_cast<float>(parameters_.drift_ratio * shutter.growth());
  columns_ = normal_values(field(kTemporalColumnStream, frame), width_px_);
  for (float& value : columns_) value *= static_cast<float>(parameters_.temporal_column_ratio);
  rows_ = normal_values(field(kTemporalRowStream, frame), height_px_);
  const double whole =
      parameters_.frame_ratio * static_cast<double>(normal_values(field(kFrameStream, frame), 1).front());
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    const double turns = static_cast<double>(y) / parameters_.banding_period_px +
                         parameters_.banding_hz * time_s + banding_phase_;
    const double band =
        parameters_.banding_ratio * std::numbers::sqrt2 * std::sin(2 * std::numbers::pi * turns);
    rows_[y] =
        static_cast<float>(parameters_.temporal_row_ratio * static_cast<double>(rows_[y]) + band + whole);
  }
}

void PatternNoise::add(std::size_t first, float stddev, std::span<float> out) const {
  if (!fixed_.empty() && !drift_.empty()) {
    add_two(&fixed_[first], stddev, &drift_[first], stddev * drifted_, out.size(), out.data());
  } else if (!fixed_.empty()) {
    add_scaled(std::span(fixed_).subspan(first, out.size()), stddev, out);
  } else if (!drift_.empty()) {
    add_scaled(std::span(drift_).subspan(first, out.size()), stddev * drifted_, out);
  }
  const auto width = static_cast<std::size_t>(width_px_);
  for (std::size_t done = 0; done < out.size();) {
    const std::size_t column = (first + done) % width;
    const std::size_t count = std::min(width - column, out.size() - done);
    add_row(&columns_[column], count, rows_[(first + done) / width], stddev, &out[done]);
    done += count;
  }
}

}  // namespace thermal
