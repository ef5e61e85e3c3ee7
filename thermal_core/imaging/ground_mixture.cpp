#include "imaging/ground_mixture.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "imaging/ground_noise.h"

namespace thermal {
namespace {

enum LoosePart : std::uint8_t { kGrass, kLitter, kTrodden, kAsh, kRock };

constexpr std::uint32_t kTussockStream = 66;
constexpr std::uint32_t kStoneStream = 67;

// Estimates:
constexpr double kTussocksM = 6;
constexpr double kTussockRoughness = 0.84;  // a spectrum that falls by the power of 2.5
constexpr float kTussockSpread = 0.8F;      // of the largest standard deviation that a share can have
constexpr float kLitterShare = 0.5F;        // below crowns
constexpr float kLitterSpread = 0.25F;
constexpr float kLeastCrownM = 1.5F;
constexpr float kAshSpread = 0.2F;
constexpr float kStonyFrom = 1.96F;  // standard deviations: one cell in forty
constexpr float kStones = 0.6F;      // for each further one
constexpr float kMostStones = 0.7F;
constexpr float kMeanStones = 0.01F;

constexpr std::size_t kMixRowsAChunk = 32;

float share_of(std::uint8_t byte) noexcept { return static_cast<float>(byte) / 255; }

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

float stones_of(float noise) noexcept {
  return std::min(kMostStones, kStones * std::max(0.0F, noise - kStonyFrom));
}

GroundMix mix_of(const GroundCovers& covers, std::size_t cell, bool below_crown, const Roughness& roughness) {
  GroundMix mix = {.kind = covers.kind[cell]};
  Left left(mix);
  const auto [tussocks, stones] = roughness;
  left.take(kRock, stones);
  left.take(kTrodden, share_of(covers.trodden[cell]));
  const float ash = share_of(covers.ash[cell]);
  left.take(kAsh, ash * (1 + kAshSpread * tussocks));
  if (mix.kind != 0) return mix;
  if (below_crown) left.take(kLitter, kLitterShare + kLitterSpread * tussocks);
  const float grass = share_of(covers.grass[cell]) * (1 - ash);
  left.take(kGrass, grass + kTussockSpread * std::sqrt(grass * (1 - grass)) * tussocks);
  return mix;
}

/// Cells of the covers along a cell of the maps.
double fineness(const GroundMaps& maps) noexcept {
  return static_cast<double>(maps.covers.cells) / static_cast<double>(maps.cells);
}

}  // namespace

std::vector<std::string> ground_part_names(const GroundCovers& covers) {
  std::vector<std::string> names = covers.kinds;
  names.insert(names.end(), kLoosePartNames.begin(), kLoosePartNames.end());
  return names;
}

GroundWindow cover_window(const GroundMaps& maps, const GroundWindow& window) {
  const double fine = fineness(maps);
  const auto part = [&](std::size_t first, std::size_t count) {
    const auto begin = static_cast<std::size_t>(std::floor(static_cast<double>(first) * fine));
    const auto end = static_cast<std::size_t>(std::ceil(static_cast<double>(first + count) * fine));
    return std::array{begin, std::min(end, maps.covers.cells) - begin};
  };
  const auto [first_x, width] = part(window.first_x, window.width);
  const auto [first_y, height] = part(window.first_y, window.height);
  return {.first_x = first_x, .first_y = first_y, .width = width, .height = height};
}

std::vector<GroundMix> ground_mixture(const GroundMaps& maps, const GroundWindow& window, bool rough,
                                      std::uint32_t seed) {
  const GroundCovers& covers = maps.covers;
  const double per_m = static_cast<double>(covers.cells) / maps.size_m;
  std::vector<float> tussocks;
  std::vector<float> stones;
  if (rough) {
    tussocks = ground_noise(window, {.length_cells = kTussocksM * per_m, .roughness = kTussockRoughness},
                            seed, kTussockStream);
    stones = ground_noise(window, {.length_cells = kFinestNoiseCells}, seed, kStoneStream);
  }
  const double fine = fineness(maps);
  const auto coarse = [&](std::size_t cell) {
    return static_cast<std::size_t>((static_cast<double>(cell) + 0.5) / fine);
  };
  std::vector<GroundMix> cells(window.width * window.height);
  parallel_for(window.height, kMixRowsAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * window.width; i < end * window.width; ++i) {
      const std::size_t x = window.first_x + i % window.width;
      const std::size_t y = window.first_y + i / window.width;
      const bool below_crown = maps.crown_top_m[coarse(y) * maps.cells + coarse(x)] > kLeastCrownM;
      const Roughness roughness = rough ? Roughness{tussocks[i], stones_of(stones[i])} : Roughness{};
      cells[i] = mix_of(covers, y * covers.cells + x, below_crown, roughness);
    }
  });
  return cells;
}

}  // namespace thermal
