#include "imaging/ground/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/interpolation.h"
#include "base/parallel.h"
#include "base/rng.h"

namespace thermal {
namespace {

constexpr double kMarginCells = 4;

/// Bounds of the ground seen so far [m].
struct Seen {
  std::array<double, 2> low = {std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};
  std::array<double, 2> high = {-std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
};

/// Adds the intersections of a ray from the camera with the planes of the lowest and the highest ground. False if it
/// goes up, or is so nearly level that it meets them far away.
bool add_ray(const std::array<double, 16>& pose, double x, double y, double lowest_m, double highest_m,
             Seen& seen) {
  constexpr double kLeastDown = 0.02;
  const auto along = [&](std::size_t row) {
    return pose[4 * row] * x + pose[4 * row + 1] * y + pose[4 * row + 2];
  };
  const double down = -along(2) / std::sqrt(x * x + y * y + 1);
  if (!(down > kLeastDown)) return false;
  for (const double height_m : {lowest_m, highest_m}) {
    const double depth = std::max(0.0, (height_m - pose[11]) / along(2));
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double place_m = pose[4 * axis + 3] + depth * along(axis);
      seen.low[axis] = std::min(seen.low[axis], place_m);
      seen.high[axis] = std::max(seen.high[axis], place_m);
    }
  }
  return true;
}

/// Range of cells, first and count, that covers an interval along an axis.
std::array<std::size_t, 2> cells_of(const GroundMaps& maps, double low_m, double high_m) {
  const double per_m = static_cast<double>(maps.cells) / maps.size_m;
  const auto last = static_cast<double>(maps.cells) - 1;
  const double first = std::clamp(std::floor((low_m + maps.size_m / 2) * per_m) - kMarginCells, 0.0, last);
  const double end = std::clamp(std::ceil((high_m + maps.size_m / 2) * per_m) + kMarginCells, first, last);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(end - first) + 1};
}

}  // namespace

GroundWindow window_of(const GroundMaps& maps, const Manifest& manifest) {
  const GroundWindow all = {.width = maps.cells, .height = maps.cells};
  if (manifest.frames.empty() || maps.height_m.empty()) return all;
  const auto [lowest, highest] = std::ranges::minmax_element(maps.height_m);
  const auto lowest_m = static_cast<double>(*lowest);
  const auto highest_m = static_cast<double>(*highest);
  const CameraIntrinsics& camera = manifest.camera;
  // Half a picture more on each side, because distorting lenses and overscan exceed a pinhole's picture.
  const double reach_x = (1.0 * camera.width_px + manifest.overscan_px) / camera.fx_px;
  const double reach_y = (1.0 * camera.height_px + manifest.overscan_px) / camera.fy_px;
  const bool distorted = !manifest.lens.is_none() || manifest.overscan_px > 0;
  const double share = distorted ? 1 : 0.55;
  Seen seen;
  for (const ManifestFrame& frame : manifest.frames) {
    if (!frame.camera_to_world) return all;
    for (const double x : {-share, share}) {
      for (const double y : {-share, share}) {
        if (!add_ray(*frame.camera_to_world, x * reach_x, y * reach_y, lowest_m, highest_m, seen)) return all;
      }
    }
  }
  const auto [first_x, width] = cells_of(maps, seen.low[0], seen.high[0]);
  const auto [first_y, height] = cells_of(maps, seen.low[1], seen.high[1]);
  return {.first_x = first_x, .first_y = first_y, .width = width, .height = height};
}

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

constexpr std::size_t kNoiseRowsPerChunk = 64;

void add_octave(const GroundWindow& window, double spacing, float amplitude, std::uint32_t seed,
                std::uint32_t stream, std::uint32_t number, std::vector<float>& noise) {
  const std::vector<Position> xs = positions(window.first_x, window.width, spacing);
  const std::vector<Position> ys = positions(window.first_y, window.height, spacing);
  const std::int64_t low_x = xs.front().point - 1;
  const auto columns = static_cast<std::size_t>(xs.back().point + 2 - low_x) + 1;
  const Octave octave = {
      .seed = seed, .stream = stream, .number = number, .low_x = low_x, .columns = columns};
  parallel_for(window.height, kNoiseRowsPerChunk, [&](std::size_t begin, std::size_t end) {
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
