#include "imaging/ground/mixture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/interpolation.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kMostCuts = 4;
constexpr std::size_t kMostCells = std::size_t{1} << 21U;

/// Range of the covers' cells that contain some cells of the maps, along an axis: first and count.
std::array<std::size_t, 2> covers_along(const GroundMaps& maps, std::size_t first, std::size_t count) {
  const double fine = static_cast<double>(maps.covers.cells) / static_cast<double>(maps.cells);
  const auto begin = static_cast<std::size_t>(std::floor(static_cast<double>(first) * fine));
  const auto end = static_cast<std::size_t>(std::ceil(static_cast<double>(first + count) * fine));
  return {begin, std::min(end, maps.covers.cells) - begin};
}

}  // namespace

CutWindow cut_window(const GroundMaps& maps, const GroundWindow& window) {
  const auto [first_x, width] = covers_along(maps, window.first_x, window.width);
  const auto [first_y, height] = covers_along(maps, window.first_y, window.height);
  std::size_t cuts = kMostCuts;
  while (cuts > 1 && cuts * cuts * width * height > kMostCells) cuts /= 2;
  return {.cells = {.first_x = cuts * first_x,
                    .first_y = cuts * first_y,
                    .width = cuts * width,
                    .height = cuts * height},
          .cuts = cuts};
}

CutCovers::CutCovers(const GroundCovers& covers, const CutWindow& window)
    : covers_(covers),
      rows_(near_cells(window.cells.first_y, window.cells.height, window.cuts, covers.cells)),
      columns_(near_cells(window.cells.first_x, window.cells.width, window.cuts, covers.cells)) {}

std::vector<CutCovers::Near> CutCovers::near_cells(std::size_t first, std::size_t count, std::size_t cuts,
                                                   std::size_t cells) {
  std::vector<Near> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(first + i) + 0.5) / static_cast<double>(cuts) - 0.5;
    const double low = std::floor(at);
    all[i].weight = spline_weights(at - low);
    for (std::size_t k = 0; k < 4; ++k) {
      const double cell = low + static_cast<double>(k) - 1;
      all[i].cell[k] = static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
    }
  }
  return all;
}

Cover CutCovers::at(std::size_t row, std::size_t column) const noexcept {
  const Near& rows = rows_[row];
  const Near& columns = columns_[column];
  Cover cover = {.kind = kind_at(rows, columns)};
  float whole = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t cell = rows.cell[j] * covers_.cells + columns.cell[i];
      if (covers_.kind[cell] != cover.kind) continue;
      const float weight = rows.weight[j] * columns.weight[i];
      whole += weight;
      cover.grass += weight * static_cast<float>(covers_.grass[cell]);
      cover.trodden += weight * static_cast<float>(covers_.trodden[cell]);
      cover.ash += weight * static_cast<float>(covers_.ash[cell]);
    }
  }
  constexpr float kAll = 255;
  for (float* share : {&cover.grass, &cover.trodden, &cover.ash}) *share /= kAll * whole;
  return cover;
}

std::uint8_t CutCovers::kind_at(const Near& rows, const Near& columns) const noexcept {
  const std::uint8_t middle = covers_.kind[rows.cell[1] * covers_.cells + columns.cell[1]];
  bool others = false;
  for (const std::size_t row : rows.cell)
    for (const std::size_t column : columns.cell)
      others |= covers_.kind[row * covers_.cells + column] != middle;
  if (!others) return middle;
  std::array<float, 256> share{};
  const auto each = [&](auto&& visit) {
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i)
        visit(rows.cell[j] * covers_.cells + columns.cell[i], rows.weight[j] * columns.weight[i]);
  };
  each([&](std::size_t cell, float weight) {
    share[covers_.kind[cell]] += weight * static_cast<float>(covers_.border[cell]);
  });
  std::uint8_t largest = middle;
  each([&](std::size_t cell, float) {
    const std::uint8_t kind = covers_.kind[cell];
    if (share[kind] > share[largest]) largest = kind;
  });
  return largest;
}

namespace {

enum LoosePart : std::uint8_t { kGrass, kLitter, kTrodden, kAsh, kRock };

constexpr std::uint32_t kTussockStream = 66;
constexpr std::uint32_t kStoneStream = 67;

// Estimates:
constexpr double kTussocksM = 6;
constexpr double kFinestTussocksM = 0.25;
constexpr double kTussockRoughness = kGroundRoughness;
constexpr float kTussockSpread = 0.8F;  // of the largest standard deviation that a share can have
constexpr float kLitterShare = 0.5F;    // below crowns
constexpr float kLitterSpread = 0.25F;
constexpr float kLitterRagged = 2;  // along their rims
constexpr float kLeastCrownM = 1.5F;
constexpr float kAshSpread = 0.2F;
constexpr float kStrewnFrom = 1.96F;  // standard deviations: one cell in forty
constexpr float kStones = 0.4F;       // for each further one
constexpr float kMostStones = 0.7F;
constexpr float kMeanStones = 0.01F;
constexpr float kGathered = 0.8F;  // the same for litter, whose temperature is closer to soil's
constexpr float kMostGathered = 0.9F;

constexpr std::size_t kMixRowsPerChunk = 32;

/// Divides what is left by successive shares, as bytes.
class Left {
 public:
  explicit Left(GroundMix& mix) : mix_(mix) {}

  void take(LoosePart part, float share) noexcept {
    const int wanted =
        static_cast<int>(std::lround(std::clamp(share, 0.0F, 1.0F) * static_cast<float>(left_)));
    mix_.share[part] = static_cast<std::uint8_t>(wanted);
    left_ -= wanted;
  }

 private:
  GroundMix& mix_;
  int left_ = 255;
};

/// Random properties of a cell beyond the maps: tussocks as a standard normal number, and shares.
struct Roughness {
  float tussocks = 0;
  float stones = kMeanStones;
  float gathered = 0;  ///< litter
};

/// Stones lie where there are no tussocks, and litter gathers where there are; both numbers are standard normal.
Roughness roughness_of(float noise, float tussocks) noexcept {
  const float stony = (noise - tussocks) / std::numbers::sqrt2_v<float>;
  const auto strewn = [](float further, float share, float most) {
    return std::min(most, share * std::max(0.0F, further - kStrewnFrom));
  };
  return {.tussocks = tussocks,
          .stones = strewn(stony, kStones, kMostStones),
          .gathered = strewn(-stony, kGathered, kMostGathered)};
}

/// Share of a point below crowns, 0 to 1: smooths the steps of the maps' cells.
class BelowCrowns {
 public:
  BelowCrowns(const GroundMaps& maps, const CutWindow& window)
      : maps_(maps),
        rows_(nodes(maps, window, window.cells.first_y, window.cells.height)),
        columns_(nodes(maps, window, window.cells.first_x, window.cells.width)) {}

  /// @param row, column  of the window
  [[nodiscard]] float at(std::size_t row, std::size_t column) const noexcept {
    const auto [low_y, high_y, up] = rows_[row];
    const auto [low_x, high_x, right] = columns_[column];
    const double south = between(low_y, low_x, high_x, right);
    const double below = south + up * (between(high_y, low_x, high_x, right) - south);
    return static_cast<float>(below);
  }

 private:
  static std::vector<BetweenNodes> nodes(const GroundMaps& maps, const CutWindow& window, std::size_t first,
                                         std::size_t count) {
    const double coarse_a_fine =
        static_cast<double>(maps.cells) / static_cast<double>(window.cuts * maps.covers.cells);
    std::vector<BetweenNodes> all;
    for (std::size_t i = 0; i < count; ++i)
      all.push_back(between_nodes((static_cast<double>(first + i) + 0.5) * coarse_a_fine - 0.5, maps.cells));
    return all;
  }
  [[nodiscard]] double between(std::size_t row, std::size_t low, std::size_t high,
                               double share) const noexcept {
    return is_below(row, low) + share * (is_below(row, high) - is_below(row, low));
  }
  [[nodiscard]] double is_below(std::size_t row, std::size_t column) const noexcept {
    return maps_.crown_top_m[row * maps_.cells + column] > kLeastCrownM ? 1 : 0;
  }

  const GroundMaps& maps_;
  std::vector<BetweenNodes> rows_;
  std::vector<BetweenNodes> columns_;
};

GroundMix mix_of(const Cover& cover, float below_crowns, const Roughness& roughness) {
  GroundMix mix = {.kind = cover.kind};
  Left left(mix);
  const auto [tussocks, stones, gathered] = roughness;
  left.take(kRock, stones);
  left.take(kTrodden, cover.trodden);
  left.take(kAsh, cover.ash * (1 + kAshSpread * tussocks));
  if (mix.kind != 0) return mix;
  const float rim = kLitterRagged * below_crowns * (1 - below_crowns) * tussocks;
  const float lain = std::clamp(2 * below_crowns - 0.5F + rim, 0.0F, 1.0F);
  left.take(kLitter, gathered + lain * (kLitterShare + kLitterSpread * tussocks));
  const float grass = cover.grass * (1 - cover.ash);
  left.take(kGrass, grass + kTussockSpread * std::sqrt(grass * (1 - grass)) * tussocks);
  return mix;
}

}  // namespace

std::vector<std::string> ground_part_names(const GroundCovers& covers) {
  std::vector<std::string> names = covers.kinds;
  names.insert(names.end(), kLoosePartNames.begin(), kLoosePartNames.end());
  return names;
}

std::vector<GroundMix> ground_mixture(const GroundMaps& maps, const CutWindow& window, bool rough,
                                      std::uint32_t seed) {
  const GroundWindow& area = window.cells;
  const double cells_a_side = static_cast<double>(window.cuts * maps.covers.cells);
  const double per_m = cells_a_side / maps.size_m;
  std::vector<float> tussocks;
  std::vector<float> stones;
  if (rough) {
    tussocks = ground_noise(area,
                            {.length_cells = kTussocksM * per_m,
                             .roughness = kTussockRoughness,
                             .finest_cells = kFinestTussocksM * per_m},
                            seed, kTussockStream);
    stones = ground_noise(area, {.length_cells = kFinestNoiseCells}, seed, kStoneStream);
  }
  const CutCovers covers(maps.covers, window);
  const BelowCrowns below_crowns(maps, window);
  std::vector<GroundMix> cells(area.width * area.height);
  parallel_for(area.height, kMixRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * area.width; i < end * area.width; ++i) {
      const std::size_t x = i % area.width;
      const std::size_t y = i / area.width;
      const Roughness roughness = rough ? roughness_of(stones[i], tussocks[i]) : Roughness();
      cells[i] = mix_of(covers.at(y, x), below_crowns.at(y, x), roughness);
    }
  });
  return cells;
}

}  // namespace thermal
