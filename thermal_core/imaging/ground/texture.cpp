#include "imaging/ground/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::uint32_t kEast = 0x5EA57000;
constexpr std::uint32_t kNorth = 0x90127000;

}  // namespace

GroundWarp::GroundWarp(std::uint32_t seed) : east_(seed ^ kEast), north_(seed ^ kNorth) {}

void GroundWarp::move(std::span<const float> x_m, std::span<const float> y_m,
                      std::span<const float> footprint_m, std::span<float> moved_x_m,
                      std::span<float> moved_y_m) const noexcept {
  east_.sample(x_m, y_m, footprint_m, moved_x_m);  // its correlation length is 1 m
  north_.sample(x_m, y_m, footprint_m, moved_y_m);
  for (std::size_t i = 0; i < moved_x_m.size(); ++i) {
    moved_x_m[i] = x_m[i] + kMoveM * moved_x_m[i];
    moved_y_m[i] = y_m[i] + kMoveM * moved_y_m[i];
  }
}

namespace {

constexpr std::size_t kTexelCellsPerChunk = 4096;
constexpr float kStepK = 1.0F / 512;
constexpr float kSkyViewSteps = 255;
constexpr float kWarmingSteps = 127;

/// Temperature, warming and sky view of a cell in one word: 16 bits, 8 and 8.
std::int32_t texel_of(float temperature_steps, float warming_steps, float sky_view) {
  constexpr float kLargest = 32767;
  const auto bits = [](float steps) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(steps)));
  };
  return static_cast<std::int32_t>(bits(std::clamp(temperature_steps, -kLargest, kLargest)) << 16U |
                                   (bits(warming_steps) & 0xFFU) << 8U | bits(sky_view * kSkyViewSteps));
}

/// Temperature of a texel some time later, in steps.
VELDT_INLINE float steps_of(std::int32_t texel, float later) noexcept {
  const auto warming = static_cast<std::int32_t>(static_cast<std::uint32_t>(texel) << 16U) >> 24;
  return static_cast<float>(texel >> 16) + later * static_cast<float>(warming);
}
VELDT_INLINE float view_of(std::int32_t texel) noexcept { return static_cast<float>(texel & 0xFF); }

VELDT_INLINE float between(float a, float b, float share) noexcept { return a + share * (b - a); }

/// Means of blocks of 2 x 2; a last odd row or column is repeated.
std::vector<float> halved(const std::vector<float>& fine, std::size_t width, std::size_t height) {
  const std::size_t half_width = (width + 1) / 2;
  std::vector<float> coarse(half_width * ((height + 1) / 2));
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const std::size_t x = 2 * (i % half_width);
    const std::size_t y = 2 * (i / half_width);
    const std::size_t right = std::min(x + 1, width - 1);
    const std::size_t above = std::min(y + 1, height - 1);
    coarse[i] = 0.25F * (fine[y * width + x] + fine[y * width + right] + fine[above * width + x] +
                         fine[above * width + right]);
  }
  return coarse;
}

/// Inputs of the loops below, the same for all pixels.
struct Window {
  const std::int32_t* texels;
  float origin_x, origin_y, base_k;
  float later;  ///< warming steps to temperature steps at this time
};

/// Per level, one entry in each array.
struct LevelTables {
  const std::int32_t* first;
  const std::int32_t* width;
  const std::int32_t* height;
  const float* per_m;
  int last;
};

/// Whether a pixel has a position on the ground. False for NaN.
VELDT_INLINE bool has_point(std::int32_t is_ground, float x, float y, float footprint) noexcept {
  constexpr float kFarthest = 1e6F;
  const float far_x = std::abs(x);
  const float far_y = std::abs(y);
  return (is_ground != 0) & (far_x < kFarthest) & (far_y < kFarthest) & (footprint >= 0) &
         (footprint < kFarthest);
}

/// From 1.5 cells on, the next level is nearer: its number is the exponent of cells / 0.75, at least 0.
VELDT_INLINE int level_of(float cells, int last) noexcept {
  constexpr int kBias = 127;  // of a float's exponent
  constexpr int kMantissaBits = 23;
  const int exponent =
      static_cast<int>(std::bit_cast<std::uint32_t>(cells * (1 / 0.75F)) >> kMantissaBits) - kBias;
  const int positive = exponent > 0 ? exponent : 0;
  return positive < last ? positive : last;
}

/// Values interpolated between the texels around a point.
struct Blended {
  float temperature_k, sky_view;
};

VELDT_INLINE Blended blend(const Window& window, std::int32_t first, std::int32_t width, std::int32_t height,
                           float per_m, float x, float y) noexcept {
  const float columns = static_cast<float>(width - 1);
  const float rows = static_cast<float>(height - 1);
  const float u = (x - window.origin_x) * per_m - 0.5F;
  const float v = (y - window.origin_y) * per_m - 0.5F;
  const float positive_u = u > 0 ? u : 0.0F;
  const float positive_v = v > 0 ? v : 0.0F;
  const float inside_u = positive_u < columns ? positive_u : columns;
  const float inside_v = positive_v < rows ? positive_v : rows;
  const auto column = static_cast<std::int32_t>(inside_u);
  const auto row = static_cast<std::int32_t>(inside_v);
  const std::int32_t right = column + 1 < width ? 1 : 0;
  const std::int32_t below = first + row * width + column;
  const std::int32_t above = below + (row + 1 < height ? width : 0);
  const std::int32_t low_left = window.texels[below];
  const std::int32_t low_right = window.texels[below + right];
  const std::int32_t high_left = window.texels[above];
  const std::int32_t high_right = window.texels[above + right];
  const float share = inside_u - static_cast<float>(column);
  const float up = inside_v - static_cast<float>(row);
  const float low = between(steps_of(low_left, window.later), steps_of(low_right, window.later), share);
  const float high = between(steps_of(high_left, window.later), steps_of(high_right, window.later), share);
  const float low_view = between(view_of(low_left), view_of(low_right), share);
  const float high_view = between(view_of(high_left), view_of(high_right), share);
  return {window.base_k + kStepK * between(low, high, up),
          (1 / kSkyViewSteps) * between(low_view, high_view, up)};
}

/// Bitwise selection, so that a compiler evaluates both values and the loop vectorises.
VELDT_INLINE float chosen(bool first, float a, float b) noexcept {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                              (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// Branch-free, so that it vectorises.
VELDT_CLONES void sample_levels(const Window& all, const LevelTables& tables,
                                const std::uint16_t* __restrict surface,
                                const std::int32_t* __restrict is_ground, const float* __restrict x,
                                const float* __restrict y, const float* __restrict footprint,
                                float* __restrict temperature_k, float* __restrict sky_view,
                                std::size_t count) noexcept {
  const Window window = all;
  const LevelTables t = tables;
  const float per_cell = t.per_m[0];
  for (std::size_t i = 0; i < count; ++i) {
    const bool usable = has_point(is_ground[surface[i]], x[i], y[i], footprint[i]);
    const int level = level_of(usable ? footprint[i] * per_cell : 0.0F, t.last);
    const Blended value = blend(window, t.first[level], t.width[level], t.height[level], t.per_m[level],
                                usable ? x[i] : 0.0F, usable ? y[i] : 0.0F);
    temperature_k[i] = chosen(usable, value.temperature_k, temperature_k[i]);
    sky_view[i] = chosen(usable, value.sky_view, -1.0F);
  }
}

/// The same for pixels that all need one level.
VELDT_CLONES void sample_level(const Window& all, const LevelTables& tables, int level,
                               const std::uint16_t* __restrict surface,
                               const std::int32_t* __restrict is_ground, const float* __restrict x,
                               const float* __restrict y, const float* __restrict footprint,
                               float* __restrict temperature_k, float* __restrict sky_view,
                               std::size_t count) noexcept {
  const Window window = all;
  const std::int32_t first = tables.first[level];
  const std::int32_t width = tables.width[level];
  const std::int32_t height = tables.height[level];
  const float per_m = tables.per_m[level];
  for (std::size_t i = 0; i < count; ++i) {
    const bool usable = has_point(is_ground[surface[i]], x[i], y[i], footprint[i]);
    const Blended value =
        blend(window, first, width, height, per_m, usable ? x[i] : 0.0F, usable ? y[i] : 0.0F);
    temperature_k[i] = chosen(usable, value.temperature_k, temperature_k[i]);
    sky_view[i] = chosen(usable, value.sky_view, -1.0F);
  }
}

}  // namespace

GroundTexture::GroundTexture(const GroundGrid& grid, GroundValues values)
    : origin_x_m_(static_cast<float>(grid.origin_x_m)),
      origin_y_m_(static_cast<float>(grid.origin_y_m)),
      base_k_(std::round(values.temperature_k.front())) {
  float fastest_k_h = 0;
  for (const float per_h_k : values.per_h_k) fastest_k_h = std::max(fastest_k_h, std::abs(per_h_k));
  warming_step_k_h_ = fastest_k_h / kWarmingSteps;
  std::size_t width = grid.width;
  std::size_t height = grid.height;
  for (double per_m = grid.cells_per_m;; per_m /= 2) {
    add_level(values, width, height, per_m);
    if (width <= 2 || height <= 2) break;
    for (auto* plane : {&values.temperature_k, &values.per_h_k, &values.sky_view})
      *plane = halved(*plane, width, height);
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
}

void GroundTexture::add_level(const GroundValues& values, std::size_t width, std::size_t height,
                              double per_m) {
  levels_.push_back({.first = static_cast<std::int32_t>(texels_.size()),
                     .width = static_cast<std::int32_t>(width),
                     .height = static_cast<std::int32_t>(height),
                     .per_m = static_cast<float>(per_m)});
  const float per_step = warming_step_k_h_ > 0 ? 1 / warming_step_k_h_ : 0.0F;
  const std::size_t first = texels_.size();
  texels_.resize(first + values.sky_view.size());
  parallel_for(values.sky_view.size(), kTexelCellsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      texels_[first + i] = texel_of((values.temperature_k[i] - base_k_) / kStepK,
                                    values.per_h_k[i] * per_step, values.sky_view[i]);
    }
  });
}

void GroundTexture::sample(const Points& points, float later_h, std::span<float> temperature_k,
                           std::span<float> sky_view) const noexcept {
  constexpr std::size_t kMostLevels = 16;
  const std::size_t count = temperature_k.size();
  assert(points.surface.size() == count && points.x_m.size() == count && sky_view.size() == count &&
         levels_.size() <= kMostLevels);
  std::array<std::int32_t, kMostLevels> first{};
  std::array<std::int32_t, kMostLevels> width{};
  std::array<std::int32_t, kMostLevels> height{};
  std::array<float, kMostLevels> per_m{};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    first[i] = levels_[i].first;
    width[i] = levels_[i].width;
    height[i] = levels_[i].height;
    per_m[i] = levels_[i].per_m;
  }
  const Window window = {texels_.data(), origin_x_m_, origin_y_m_, base_k_,
                         later_h * warming_step_k_h_ / kStepK};
  const LevelTables tables = {first.data(), width.data(), height.data(), per_m.data(),
                              static_cast<int>(levels_.size()) - 1};
  const std::uint16_t* surface = points.surface.data();
  const std::int32_t* is_ground = points.is_ground.data();
  const float* x = points.x_m.data();
  const float* y = points.y_m.data();
  const float* footprint = points.footprint_m.data();
  const int low = level_of(std::bit_cast<float>(points.footprints.smallest) * per_m[0], tables.last);
  if (low == level_of(std::bit_cast<float>(points.footprints.largest) * per_m[0], tables.last)) {
    sample_level(window, tables, low, surface, is_ground, x, y, footprint, temperature_k.data(),
                 sky_view.data(), count);
  } else {
    sample_levels(window, tables, surface, is_ground, x, y, footprint, temperature_k.data(), sky_view.data(),
                  count);
  }
}

}  // namespace thermal
