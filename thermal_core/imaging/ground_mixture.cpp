#include "imaging/ground_mixture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "imaging/ground_noise.h"

namespace thermal {
namespace {

enum LoosePart : std::uint8_t { kGrass, kLitter, kTrodden, kAsh, kRock };

constexpr std::uint32_t kTussockStream = 66;
constexpr std::uint32_t kStoneStream = 67;

// Estimates:
constexpr double kTussocksM = 6;
constexpr double kFinestTussocksM = 0.25;
constexpr double kTussockRoughness = 0.84;  // a spectrum that falls by the power of 2.5
constexpr float kTussockSpread = 0.8F;      // of the largest standard deviation that a share can have
constexpr float kLitterShare = 0.5F;        // below crowns
constexpr float kLitterSpread = 0.25F;
constexpr float kLeastCrownM = 1.5F;
constexpr float kAshSpread = 0.2F;
constexpr float kStonyFrom = 1.96F;  // standard deviations: one cell in forty
constexpr float kStones = 0.4F;      // for each further one
constexpr float kMostStones = 0.7F;
constexpr float kMeanStones = 0.01F;

constexpr std::size_t kMixRowsAChunk = 32;

/// Shares of what is left after each other, as bytes.
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

/// What a cell has that the maps do not: tussocks as a standard normal number, and the share of stones.
struct Roughness {
  float tussocks = 0;
  float stones = kMeanStones;
};

/// Stones lie where there are no tussocks; both numbers are standard normal.
float stones_of(float noise, float tussocks) noexcept {
  const float stony = (noise - tussocks) / std::numbers::sqrt2_v<float>;
  return std::min(kMostStones, kStones * std::max(0.0F, stony - kStonyFrom));
}

GroundMix mix_of(const Cover& cover, bool below_crown, const Roughness& roughness) {
  GroundMix mix = {.kind = cover.kind};
  Left left(mix);
  const auto [tussocks, stones] = roughness;
  left.take(kRock, stones);
  left.take(kTrodden, cover.trodden);
  left.take(kAsh, cover.ash * (1 + kAshSpread * tussocks));
  if (mix.kind != 0) return mix;
  if (below_crown) left.take(kLitter, kLitterShare + kLitterSpread * tussocks);
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
  const double coarse_a_fine = static_cast<double>(maps.cells) / cells_a_side;
  const auto coarse = [&](std::size_t cell) {
    return static_cast<std::size_t>((static_cast<double>(cell) + 0.5) * coarse_a_fine);
  };
  const CutCovers covers(maps.covers, window);
  std::vector<GroundMix> cells(area.width * area.height);
  parallel_for(area.height, kMixRowsAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * area.width; i < end * area.width; ++i) {
      const std::size_t x = i % area.width;
      const std::size_t y = i / area.width;
      const std::size_t of_maps = coarse(area.first_y + y) * maps.cells + coarse(area.first_x + x);
      const bool below_crown = maps.crown_top_m[of_maps] > kLeastCrownM;
      const Roughness roughness =
          rough ? Roughness{tussocks[i], stones_of(stones[i], tussocks[i])} : Roughness{};
      cells[i] = mix_of(covers.at(y, x), below_crown, roughness);
    }
  });
  return cells;
}

}  // namespace thermal
