#include "scene/variation_field.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/clones.h"
#include "base/image.h"
#include "base/parallel.h"
#include "base/rng.h"

namespace thermal {
namespace {

constexpr int kTexels = 256;            // of the finest level, along each axis
constexpr float kTexelsPerLength = 16;  // so that the field repeats after 16 correlation lengths
constexpr int kOctaves = 5;             // lattice spacings of 16, 8, 4, 2 and 1 texels
constexpr double kRoughness = 0.6;      // amplitude of an octave against the one above it
constexpr std::uint32_t kStream = 64;

/// Uniform cubic B-spline weights at a fraction t between two lattice points.
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
  const auto value_at = [&](int x, int y) {
    const auto wx = spline_weights(static_cast<double>(x % spacing) / spacing);
    const auto wy = spline_weights(static_cast<double>(y % spacing) / spacing);
    double sum = 0;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        sum += wy.at(static_cast<std::size_t>(j)) * wx.at(static_cast<std::size_t>(i)) *
               at(x / spacing + i - 1, y / spacing + j - 1);
      }
    }
    return sum;
  };
  constexpr std::size_t kTexelsPerChunk = 16 * kTexels;
  parallel_for(field.size(), kTexelsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (auto texel = static_cast<int>(begin); texel < static_cast<int>(end); ++texel)
      field[static_cast<std::size_t>(texel)] += amplitude * value_at(texel % kTexels, texel / kTexels);
  });
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

/// Floor, for values that fit an int.
inline int floor_to_int(float value) noexcept {
  const auto truncated = static_cast<int>(value);
  return truncated - (static_cast<float>(truncated) > value ? 1 : 0);
}

/// Step of a stored texel: rounding moves the field by 1.2e-4 standard deviations at most; |texel| < 8 is kept.
constexpr float kUnit = 1.0F / 4096;

/// A texel and its right neighbour in one word, which halves the reads.
std::int32_t packed(float left, float right) {
  const auto steps = [](float value) {
    constexpr float kLargest = 32767;
    return static_cast<std::int32_t>(std::clamp(std::round(value / kUnit), -kLargest, kLargest));
  };
  return static_cast<std::int32_t>((static_cast<std::uint32_t>(steps(right)) << 16U) |
                                   (static_cast<std::uint32_t>(steps(left)) & 0xFFFFU));
}

inline float left_of(std::int32_t pair) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(pair) << 16U) >> 16);
}

inline float right_of(std::int32_t pair) noexcept { return static_cast<float>(pair >> 16); }

/// Interpolates a level's texels linearly at points. Branch-free, so that it vectorises.
VELDT_CLONES void sample_all(const std::int32_t* __restrict texels, const float* __restrict x,
                             const float* __restrict y, const float* __restrict footprint,
                             float* __restrict value, std::size_t count) noexcept {
  constexpr float kFarthest = 1e5F;  // beyond it, single precision cannot distinguish texels
  constexpr int kAllTexels = 87381;  // of all levels together: 256^2 + 128^2 + … + 1
  constexpr int kBias = 127;         // of a float's exponent
  constexpr int kMantissaBits = 23;
  constexpr int kTexelsBits = 8;
  for (std::size_t i = 0; i < count; ++i) {
    const float wanted = footprint[i] * kTexelsPerLength;
    const float far_x = std::abs(x[i]);
    const float far_y = std::abs(y[i]);
    const bool usable = (far_x < kFarthest) & (far_y < kFarthest) & (wanted >= 0) &
                        (wanted < static_cast<float>(kTexels));  // false for NaN
    const float texel = usable ? wanted : 0.0F;
    // From 1.5 texels on, the next level is nearer: its number is the exponent of texels / 0.75, at least 0.
    const int exponent =
        static_cast<int>(std::bit_cast<std::uint32_t>(texel * (1 / 0.75F)) >> kMantissaBits) - kBias;
    const int level = exponent > 0 ? exponent : 0;
    const float shrink = std::bit_cast<float>(static_cast<std::uint32_t>(kBias - level) << kMantissaBits);
    // The middle of a coarser level's texel is shifted by half its width minus half a fine texel.
    const float shift = 0.5F - 0.5F * shrink;
    const float u = (usable ? x[i] : 0.0F) * (kTexelsPerLength * shrink) - shift;
    const float v = (usable ? y[i] : 0.0F) * (kTexelsPerLength * shrink) - shift;
    const int column = floor_to_int(u);
    const int row = floor_to_int(v);
    const int mask = (kTexels >> level) - 1;
    const int first = kAllTexels - (kAllTexels >> (2 * level));
    const int place = first + (column & mask);
    const std::int32_t above = texels[place + ((row & mask) << (kTexelsBits - level))];
    const std::int32_t below = texels[place + (((row + 1) & mask) << (kTexelsBits - level))];
    const float s = u - static_cast<float>(column);
    const float t = v - static_cast<float>(row);
    const float top = left_of(above) + s * (right_of(above) - left_of(above));
    const float bottom = left_of(below) + s * (right_of(below) - left_of(below));
    value[i] = usable ? kUnit * (top + t * (bottom - top)) : 0.0F;
  }
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
  Plane<float> level(kTexels, kTexels);
  std::transform(field.begin(), field.end(), level.pixels().begin(),
                 [](double value) { return static_cast<float>(value); });
  for (; level.width_px() >= 1; level = halved(level)) {
    for (int y = 0; y < level.height_px(); ++y) {
      for (int x = 0; x < level.width_px(); ++x) {
        texels_.push_back(packed(level.at(x, y), level.at((x + 1) % level.width_px(), y)));
      }
    }
  }
}

void VariationField::sample(std::span<const float> x, std::span<const float> y,
                            std::span<const float> footprint, std::span<float> value) const noexcept {
  assert(x.size() == value.size() && y.size() == value.size() && footprint.size() == value.size());
  sample_all(texels_.data(), x.data(), y.data(), footprint.data(), value.data(), value.size());
}

}  // namespace thermal
