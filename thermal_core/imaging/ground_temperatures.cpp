#include "imaging/ground_temperatures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/clones.h"
#include "base/parallel.h"
#include "imaging/ground_noise.h"

namespace thermal {
namespace {

constexpr std::uint32_t kNoiseStream = 65;
constexpr float kStepK = 1.0F / 512;
constexpr std::size_t kGroundRowsAChunk = 16;

/// Normals of level grids of heights, by the slopes between the neighbours of a cell.
class Slopes {
 public:
  explicit Slopes(const GroundMaps& maps)
      : maps_(maps), per_m_(static_cast<double>(maps.cells) / maps.size_m) {}

  [[nodiscard]] EastNorthUp normal(std::size_t x, std::size_t y) const {
    const std::size_t last = maps_.cells - 1;
    const double east = slope(std::min(x + 1, last), y, x == 0 ? 0 : x - 1, y);
    const double north = slope(x, std::min(y + 1, last), x, y == 0 ? 0 : y - 1);
    const double length = std::sqrt(east * east + north * north + 1);
    return {-east / length, -north / length, 1 / length};
  }

 private:
  [[nodiscard]] double slope(std::size_t x1, std::size_t y1, std::size_t x0, std::size_t y0) const {
    const auto cells = static_cast<double>(x1 - x0 + y1 - y0);
    return cells > 0 ? (height(x1, y1) - height(x0, y0)) * per_m_ / cells : 0;
  }
  [[nodiscard]] double height(std::size_t x, std::size_t y) const {
    return static_cast<double>(maps_.height_m[y * maps_.cells + x]);
  }

  const GroundMaps& maps_;
  double per_m_;
};

double share_of(std::uint8_t byte) { return byte / 255.0; }

/// The sky view of a window's cells, above the value that texels count from.
std::vector<float> sky_view_of(const GroundMaps& maps, const GroundWindow& window, float base) {
  std::vector<float> view(window.width * window.height);
  for (std::size_t i = 0; i < view.size(); ++i) {
    const std::size_t cell =
        (window.first_y + i / window.width) * maps.cells + window.first_x + i % window.width;
    view[i] = base + static_cast<float>(share_of(maps.sky_view[cell]));
  }
  return view;
}

/// A texel and its right neighbour in one word, which halves the reads.
std::int32_t packed(float left_k, float right_k, float base_k) {
  const auto steps = [base_k](float value_k) {
    constexpr float kLargest = 32767;
    return static_cast<std::int32_t>(
        std::clamp(std::round((value_k - base_k) / kStepK), -kLargest, kLargest));
  };
  return static_cast<std::int32_t>((static_cast<std::uint32_t>(steps(right_k)) << 16U) |
                                   (static_cast<std::uint32_t>(steps(left_k)) & 0xFFFFU));
}

VELDT_INLINE float left_of(std::int32_t pair) noexcept {
  return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(pair) << 16U) >> 16);
}
VELDT_INLINE float right_of(std::int32_t pair) noexcept { return static_cast<float>(pair >> 16); }

/// Means of blocks of 2 x 2; a last odd row or column counts twice.
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

/// What the loops below read, the same for all pixels.
struct Window {
  const std::int32_t* texels;
  float origin_x, origin_y, base_k;
};

/// Levels, one entry each, in arrays.
struct LevelTables {
  const std::int32_t* first;
  const std::int32_t* width;
  const std::int32_t* height;
  const float* per_m;
  int last;
};

/// Whether a pixel has a place on the ground. False for NaN.
VELDT_INLINE bool has_place(std::int32_t cover, float x, float y, float footprint) noexcept {
  constexpr float kFarthest = 1e6F;
  const float far_x = std::abs(x);
  const float far_y = std::abs(y);
  return (cover >= 0) & (far_x < kFarthest) & (far_y < kFarthest) & (footprint >= 0) &
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

VELDT_INLINE float blend(const Window& window, std::int32_t first, std::int32_t width, std::int32_t height,
                         float per_m, float x, float y, std::int32_t cover) noexcept {
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
  const std::int32_t above_row = row + (row + 1 < height ? 1 : 0);
  const std::int32_t start = first + cover * width * height + column;
  const std::int32_t below = window.texels[start + row * width];
  const std::int32_t above = window.texels[start + above_row * width];
  const float p = inside_u - static_cast<float>(column);
  const float q = inside_v - static_cast<float>(row);
  const float low = left_of(below) + p * (right_of(below) - left_of(below));
  const float high = left_of(above) + p * (right_of(above) - left_of(above));
  return window.base_k + kStepK * (low + q * (high - low));
}

/// By bits, so that a compiler computes both values and the loop vectorises.
VELDT_INLINE float chosen(bool first, float a, float b) noexcept {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                              (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// Smallest and largest footprint of the pixels that have a place; the largest is negative if none has. Compared as
/// whole numbers, which positive floats are ordered as, so that the loop vectorises.
struct FootprintRange {
  std::int32_t smallest = std::numeric_limits<std::int32_t>::max();
  std::int32_t largest = -1;
};
VELDT_CLONES void find_footprints(const std::uint16_t* __restrict surface,
                                  const std::int32_t* __restrict cover_of, const float* __restrict x,
                                  const float* __restrict y, const float* __restrict footprint,
                                  std::size_t count, FootprintRange& range) noexcept {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  std::int32_t smallest = range.smallest;
  std::int32_t largest = range.largest;
  for (std::size_t i = 0; i < count; ++i) {
    const bool usable = has_place(cover_of[surface[i]], x[i], y[i], footprint[i]);
    const std::int32_t bits = std::bit_cast<std::int32_t>(footprint[i]);
    const std::int32_t known = bits | (static_cast<std::int32_t>(usable) - 1);  // -1 if it is not usable
    const std::int32_t low = known & kMost;
    smallest = low < smallest ? low : smallest;
    largest = known > largest ? known : largest;
  }
  range = {.smallest = smallest, .largest = largest};
}

/// Branch-free, so that it vectorises.
VELDT_CLONES void sample_levels(const Window& all, const LevelTables& tables,
                                const std::uint16_t* __restrict surface,
                                const std::int32_t* __restrict cover_of, const float* __restrict x,
                                const float* __restrict y, const float* __restrict footprint,
                                float* __restrict out, std::size_t count) noexcept {
  const Window window = all;
  const LevelTables t = tables;
  const float per_cell = t.per_m[0];
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t cover = cover_of[surface[i]];
    const bool usable = has_place(cover, x[i], y[i], footprint[i]);
    const int level = level_of(usable ? footprint[i] * per_cell : 0.0F, t.last);
    const float value = blend(window, t.first[level], t.width[level], t.height[level], t.per_m[level],
                              usable ? x[i] : 0.0F, usable ? y[i] : 0.0F, usable ? cover : 0);
    out[i] = chosen(usable, value, out[i]);
  }
}

/// The same for pixels that all need one level.
VELDT_CLONES void sample_level(const Window& all, const LevelTables& tables, int level,
                               const std::uint16_t* __restrict surface,
                               const std::int32_t* __restrict cover_of, const float* __restrict x,
                               const float* __restrict y, const float* __restrict footprint,
                               float* __restrict out, std::size_t count) noexcept {
  const Window window = all;
  const std::int32_t first = tables.first[level];
  const std::int32_t width = tables.width[level];
  const std::int32_t height = tables.height[level];
  const float per_m = tables.per_m[level];
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t cover = cover_of[surface[i]];
    const bool usable = has_place(cover, x[i], y[i], footprint[i]);
    const float value = blend(window, first, width, height, per_m, usable ? x[i] : 0.0F, usable ? y[i] : 0.0F,
                              usable ? cover : 0);
    out[i] = chosen(usable, value, out[i]);
  }
}

}  // namespace

GroundTemperatures::GroundTemperatures(const GroundMaps& maps, const GroundWindow& window,
                                       std::span<const float> sunlit, double open_moisture,
                                       std::span<const Cover> covers, std::uint32_t seed)
    : width_(window.width), height_(window.height), crown_top_m_(window.width * window.height) {
  const double per_m = static_cast<double>(maps.cells) / maps.size_m;
  origin_x_m_ = static_cast<float>(static_cast<double>(window.first_x) / per_m - maps.size_m / 2);
  origin_y_m_ = static_cast<float>(static_cast<double>(window.first_y) / per_m - maps.size_m / 2);
  std::vector<std::vector<float>> covers_k;
  for (const Cover& cover : covers) {
    covers_k.push_back(ground_noise(window, cover.correlation_length_m * per_m, seed, kNoiseStream));
    for (float& noise : covers_k.back()) noise *= static_cast<float>(cover.stddev_k);
  }
  const Slopes slopes(maps);
  parallel_for(height_, kGroundRowsAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * width_; i < end * width_; ++i) {
      const std::size_t x = window.first_x + i % width_;
      const std::size_t y = window.first_y + i / width_;
      const std::size_t cell = y * maps.cells + x;
      crown_top_m_[i] = maps.height_m[cell] + maps.crown_top_m[cell];
      const SurfacePlace place = {
          .normal = slopes.normal(x, y),
          .sky_view = share_of(maps.sky_view[cell]),
          .sunlit = sunlit.empty() ? 1 : static_cast<double>(sunlit[cell]),
          .moisture = open_moisture + (1 - open_moisture) * share_of(maps.moisture[cell])};
      for (std::size_t c = 0; c < covers.size(); ++c)
        covers_k[c][i] += static_cast<float>(covers[c].heat->temperature_k(place));
    }
  });
  base_k_ = covers_k.empty() ? 0 : std::round(covers_k.front().front());
  covers_ = static_cast<std::int32_t>(covers_k.size());
  covers_k.push_back(sky_view_of(maps, window, base_k_));
  std::size_t width = width_;
  std::size_t height = height_;
  for (double cells_per_m = per_m;; cells_per_m /= 2) {
    add_level(covers_k, width, height, cells_per_m);
    if (width <= 2 || height <= 2) break;
    for (std::vector<float>& cover_k : covers_k) cover_k = halved(cover_k, width, height);
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
}

void GroundTemperatures::add_level(const std::vector<std::vector<float>>& covers_k, std::size_t width,
                                   std::size_t height, double per_m) {
  levels_.push_back({.first = static_cast<std::int32_t>(texels_.size()),
                     .width = static_cast<std::int32_t>(width),
                     .height = static_cast<std::int32_t>(height),
                     .per_m = static_cast<float>(per_m)});
  for (const std::vector<float>& cover_k : covers_k) {
    for (std::size_t i = 0; i < cover_k.size(); ++i) {
      const bool last = i % width + 1 == width;
      texels_.push_back(packed(cover_k[i], cover_k[last ? i : i + 1], base_k_));
    }
  }
}

void GroundTemperatures::sample(const Places& places, std::span<float> temperature_k) const noexcept {
  sample_layers(places, base_k_, temperature_k);
}

void GroundTemperatures::sample_sky_view(const Places& places, std::span<float> sky_view) const {
  std::vector<std::int32_t> layer(places.cover_of_surface.begin(), places.cover_of_surface.end());
  for (std::int32_t& one : layer) one = one < 0 ? -1 : covers_;
  Places of_layer = places;
  of_layer.cover_of_surface = layer;
  sample_layers(of_layer, 0, sky_view);
}

void GroundTemperatures::sample_layers(const Places& places, float base,
                                       std::span<float> values) const noexcept {
  constexpr std::size_t kMostLevels = 16;
  const std::size_t count = values.size();
  assert(places.surface.size() == count && places.x_m.size() == count && levels_.size() <= kMostLevels);
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
  const Window window = {texels_.data(), origin_x_m_, origin_y_m_, base};
  const LevelTables tables = {first.data(), width.data(), height.data(), per_m.data(),
                              static_cast<int>(levels_.size()) - 1};
  const std::uint16_t* surface = places.surface.data();
  const std::int32_t* cover = places.cover_of_surface.data();
  const float* x = places.x_m.data();
  const float* y = places.y_m.data();
  const float* footprint = places.footprint_m.data();
  FootprintRange range;
  find_footprints(surface, cover, x, y, footprint, count, range);
  if (range.largest < 0) return;
  const int low = level_of(std::bit_cast<float>(range.smallest) * per_m[0], tables.last);
  if (low == level_of(std::bit_cast<float>(range.largest) * per_m[0], tables.last)) {
    sample_level(window, tables, low, surface, cover, x, y, footprint, values.data(), count);
  } else {
    sample_levels(window, tables, surface, cover, x, y, footprint, values.data(), count);
  }
}

float GroundTemperatures::crown_top_m(float x_m, float y_m) const noexcept {
  const auto cell_of = [this](float place_m, float origin_m, std::size_t count) {
    const float cell = (place_m - origin_m) * levels_.front().per_m;
    return static_cast<std::size_t>(std::clamp(cell, 0.0F, static_cast<float>(count - 1)));
  };
  if (std::isnan(x_m) || std::isnan(y_m)) return crown_top_m_.front();
  return crown_top_m_[cell_of(y_m, origin_y_m_, height_) * width_ + cell_of(x_m, origin_x_m_, width_)];
}

}  // namespace thermal
