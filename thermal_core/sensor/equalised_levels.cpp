#include "sensor/equalised_levels.h"

#include <algorithm>

namespace thermal {

std::pair<std::size_t, std::size_t> between_tails(std::span<const std::uint32_t> histogram,
                                                  double tail_pixels) {
  std::size_t low = 0;
  std::size_t high = histogram.size() - 1;
  double below = histogram[low];
  double above = histogram[high];
  while (below <= tail_pixels) below += histogram[++low];
  while (above <= tail_pixels) above += histogram[--high];
  return {low, high};
}

std::vector<double> equalised_levels(const LevelBins& bins, std::size_t first,
                                     const std::vector<double>& shares) {
  constexpr double kTopLevel = 255;
  double all = 0;
  for (const double share : shares) all += share;
  std::vector<double> rise(shares.size());
  double risen = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    rise[i] = std::min(bins.steepest, shares[i] * kTopLevel / all);
    risen += rise[i];
  }
  std::vector<double> levels(bins.size() + 1, 0);
  levels[first] = 0.5 * (kTopLevel - risen);
  std::size_t bin = first;
  for (const double here : rise) {
    levels[bin + 1] = std::min(kTopLevel, levels[bin] + here);
    ++bin;
  }
  for (; bin + 1 < levels.size() && levels[bin] < kTopLevel; ++bin)
    levels[bin + 1] = std::min(kTopLevel, levels[bin] + bins.steepest);
  std::fill(levels.begin() + static_cast<std::ptrdiff_t>(bin), levels.end(), levels[bin]);
  for (bin = first; bin > 0 && levels[bin] > 0; --bin)
    levels[bin - 1] = std::max(0.0, levels[bin] - bins.steepest);
  return levels;
}

}  // namespace thermal
