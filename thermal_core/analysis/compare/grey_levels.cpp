#include "analysis/compare/grey_levels.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

/// Smallest level with at least this share of the pixels at or below it.
std::size_t level_at(const std::array<double, kGreyLevels>& shares, double share) {
  double sum = 0;
  for (std::size_t level = 0; level < kGreyLevels; ++level) {
    sum += shares[level];
    if (sum >= share) return level;
  }
  return kGreyLevels - 1;
}

void find_comb(std::size_t low, std::size_t high, GreyLevels& found) {
  double sum = 0;
  double steps = 0;
  double empty = 0;
  for (std::size_t level = low; level <= high; ++level) {
    sum += found.shares[level];
    empty += found.shares[level] == 0 ? 1 : 0;
    if (level > low) steps += std::abs(found.shares[level] - found.shares[level - 1]);
  }
  const auto levels = static_cast<double>(high - low + 1);
  found.empty_share = empty / levels;
  if (levels > 1) found.roughness = steps / (levels - 1) / (sum / levels);
}

}  // namespace

GreyLevels grey_levels(const Plane<float>& frame) {
  GreyLevels found;
  const double share = 1.0 / static_cast<double>(frame.size());
  std::array<std::size_t, kGreyLevels> counts{};
  double sum = 0;
  double squares = 0;
  for (const float pixel : frame.pixels()) {
    const auto level = static_cast<double>(pixel);
    ++counts[static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 255L))];
    sum += level;
    squares += level * level;
  }
  for (std::size_t level = 0; level < kGreyLevels; ++level)
    found.shares[level] = static_cast<double>(counts[level]) * share;
  found.mean = sum * share;
  found.deviation = std::sqrt(std::max(0.0, squares * share - found.mean * found.mean));
  const std::size_t low = level_at(found.shares, 0.01);
  const std::size_t high = level_at(found.shares, 0.99);
  found.low = static_cast<double>(low);
  found.high = static_cast<double>(high);
  find_comb(low, high, found);
  return found;
}

}  // namespace thermal
