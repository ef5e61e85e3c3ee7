#include "scene/variation_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rng.h"

namespace thermal {
namespace {

constexpr int kTexels = 256;            // of the finest level, each way
constexpr float kTexelsPerLength = 16;  // so that the field repeats after 16 correlation lengths
constexpr int kOctaves = 5;             // lattice spacings of 16, 8, 4, 2 and 1 texels
constexpr double kRoughness = 0.6;      // amplitude of an octave against the one above it
constexpr std::uint32_t kStream = 64;

/// Uniform cubic B-spline weights at a share t between two lattice points.
std::array<double, 4> spline_weights(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
          t * t * t / 6};
}

/// Adds smooth noise whose lattice points are `spacing` texels apart; it repeats after kTexels.
void add_octave(std::uint32_t seed, int octave, double amplitude, std::vector<double>& field) {
  const int spacing = 16 >> octave;
  const int points = kTexels / spacing;
  std::vector<float> lattice(static_cast<std::size_t>(points) * static_cast<std::size_t>(points));
  fill_normal({.seed = seed, .stream = kStream, .clip = 0, .frame = static_cast<std::uint32_t>(octave)}, 0,
              lattice);
  const auto at = [&](int x, int y) {
    const int column = (x + points) % points;
    const int row = (y + points) % points;
    return static_cast<double>(lattice[static_cast<std::size_t>(row * points + column)]);
  };
  for (int y = 0; y < kTexels; ++y) {
    const auto wy = spline_weights(static_cast<double>(y % spacing) / spacing);
    for (int x = 0; x < kTexels; ++x) {
      const auto wx = spline_weights(static_cast<double>(x % spacing) / spacing);
      double sum = 0;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          sum += wy.at(static_cast<std::size_t>(j)) * wx.at(static_cast<std::size_t>(i)) *
                 at(x / spacing + i - 1, y / spacing + j - 1);
        }
      }
      field[static_cast<std::size_t>(y * kTexels + x)] += amplitude * sum;
    }
  }
}

/// Shifts and scales to mean 0 and variance 1.
void standardise(std::vector<double>& field) {
  double mean = 0;
  for (const double value : field) mean += value;
  mean /= static_cast<double>(field.size());
  double variance = 0;
  for (const double value : field) variance += (value - mean) * (value - mean);
  const double scale = 1 / std::sqrt(variance / static_cast<double>(field.size()));
  for (double& value : field) value = (value - mean) * scale;
}

/// Means of blocks of 2 x 2.
Plane<float> halved(const Plane<float>& fine) {
  Plane<float> coarse(fine.width_px() / 2, fine.height_px() / 2);
  for (int y = 0; y < coarse.height_px(); ++y) {
    for (int x = 0; x < coarse.width_px(); ++x) {
      coarse.at(x, y) = 0.25F * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) +
                                 fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1));
    }
  }
  return coarse;
}

}  // namespace

VariationField::VariationField(std::uint32_t seed) {
  std::vector<double> field(static_cast<std::size_t>(kTexels) * kTexels);
  double amplitude = 1;
  for (int octave = 0; octave < kOctaves; ++octave) {
    add_octave(seed, octave, amplitude, field);
    amplitude *= kRoughness;
  }
  standardise(field);
  Plane<float>& finest = levels_.emplace_back(kTexels, kTexels);
  std::transform(field.begin(), field.end(), finest.pixels().begin(),
                 [](double value) { return static_cast<float>(value); });
  while (levels_.back().width_px() > 1) levels_.push_back(halved(levels_.back()));
}

float VariationField::sample(float x, float y, float footprint) const noexcept {
  constexpr float kFarthest = 1e6F;  // beyond it, single precision no longer tells texels apart
  const bool usable = std::abs(x) < kFarthest && std::abs(y) < kFarthest;  // false for NaN
  if (!usable || !(footprint * kTexelsPerLength < static_cast<float>(kTexels))) return 0;
  std::size_t level = 0;
  float texels_per_length = kTexelsPerLength;
  while (footprint * texels_per_length > 1.5F) {  // from 1.5 texels on, the next level is nearer
    texels_per_length *= 0.5F;
    ++level;
  }
  const Plane<float>& plane = levels_[level];
  const int mask = plane.width_px() - 1;
  // A texel of a coarser level has its middle half a texel minus half a fine one further on.
  const float shift = 0.5F - 0.5F * texels_per_length / kTexelsPerLength;
  const float u = x * texels_per_length - shift;
  const float v = y * texels_per_length - shift;
  const float column = std::floor(u);
  const float row = std::floor(v);
  const float s = u - column;
  const float t = v - row;
  const int x0 = static_cast<int>(column) & mask;
  const int y0 = static_cast<int>(row) & mask;
  const int x1 = (x0 + 1) & mask;
  const int y1 = (y0 + 1) & mask;
  const float above = plane.at(x0, y0) + s * (plane.at(x1, y0) - plane.at(x0, y0));
  const float below = plane.at(x0, y1) + s * (plane.at(x1, y1) - plane.at(x0, y1));
  return above + t * (below - above);
}

}  // namespace thermal
