#include "imaging/ground_noise.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/rng.h"
#include "base/spline_weights.h"

namespace thermal {
namespace {

/// A standard normal number of a lattice point.
float lattice_value(std::uint32_t seed, std::uint32_t stream, std::uint32_t octave, std::int64_t x,
                    std::int64_t y) {
  const auto words = Philox4x32::generate(
      {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), octave, stream}, {seed, 0x6E0153});
  // The sum of four uniform numbers, scaled to variance 1: near enough to normal for temperatures.
  double sum = 0;
  for (const std::uint32_t word : words) sum += word * 0x1p-32 - 0.5;
  return static_cast<float>(sum * std::numbers::sqrt3);
}

/// Position of a cell between lattice points.
struct Position {
  std::int64_t point = 0;
  std::array<float, 4> weights{};
};

std::vector<Position> positions(std::size_t first, std::size_t count, double spacing) {
  std::vector<Position> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(first + i) + 0.5) / spacing;
    all[i] = {.point = static_cast<std::int64_t>(std::floor(at)),
              .weights = spline_weights(at - std::floor(at))};
  }
  return all;
}

/// Variance of smooth noise, averaged over a cell of its lattice: (sum of squared weights, averaged)^2.
constexpr double kSmoothVariance = 0.4794 * 0.4794;

/// The lattice of an octave, of which a block of rows is kept at a time.
struct Octave {
  std::uint32_t seed = 0;
  std::uint32_t stream = 0;
  std::uint32_t number = 0;
  std::int64_t low_x = 0;  ///< the first point
  std::size_t columns = 0;

  [[nodiscard]] std::vector<float> rows(std::int64_t low_y, std::size_t count) const {
    std::vector<float> values(count * columns);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = lattice_value(seed, stream, number, low_x + static_cast<std::int64_t>(i % columns),
                                low_y + static_cast<std::int64_t>(i / columns));
    }
    return values;
  }
};

constexpr std::size_t kNoiseRowsAChunk = 64;

void add_octave(const GroundWindow& window, double spacing, float amplitude, std::uint32_t seed,
                std::uint32_t stream, std::uint32_t number, std::vector<float>& noise) {
  const std::vector<Position> xs = positions(window.first_x, window.width, spacing);
  const std::vector<Position> ys = positions(window.first_y, window.height, spacing);
  const std::int64_t low_x = xs.front().point - 1;
  const auto columns = static_cast<std::size_t>(xs.back().point + 2 - low_x) + 1;
  const Octave octave = {
      .seed = seed, .stream = stream, .number = number, .low_x = low_x, .columns = columns};
  parallel_for(window.height, kNoiseRowsAChunk, [&](std::size_t begin, std::size_t end) {
    const std::int64_t low_y = ys[begin].point - 1;
    const std::vector<float> lattice =
        octave.rows(low_y, static_cast<std::size_t>(ys[end - 1].point + 2 - low_y) + 1);
    std::vector<float> line(columns);
    for (std::size_t row = begin; row < end; ++row) {
      const float* below = &lattice[static_cast<std::size_t>(ys[row].point - 1 - low_y) * columns];
      for (std::size_t c = 0; c < columns; ++c) {
        line[c] = 0;
        for (std::size_t j = 0; j < 4; ++j) line[c] += ys[row].weights[j] * below[j * columns + c];
      }
      float* out = &noise[row * window.width];
      for (std::size_t column = 0; column < window.width; ++column) {
        const auto c = static_cast<std::size_t>(xs[column].point - 1 - low_x);
        float sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum += xs[column].weights[i] * line[c + i];
        out[column] += amplitude * sum;
      }
    }
  });
}

}  // namespace

std::vector<float> ground_noise(const GroundWindow& window, const NoiseOctaves& octaves, std::uint32_t seed,
                                std::uint32_t stream) {
  std::vector<float> noise(window.width * window.height);
  double variance = 0;
  double amplitude = 1;
  for (double spacing = octaves.length_cells; spacing >= octaves.finest_cells;
       spacing /= 2, amplitude *= octaves.roughness)
    variance += amplitude * amplitude * kSmoothVariance;
  std::uint32_t octave = 0;
  amplitude = variance > 0 ? 1 / std::sqrt(variance) : 0;
  for (double spacing = octaves.length_cells; spacing >= kFinestNoiseCells;
       spacing /= 2, amplitude *= octaves.roughness)
    add_octave(window, spacing, static_cast<float>(amplitude), seed, stream, octave++, noise);
  return noise;
}

}  // namespace thermal
