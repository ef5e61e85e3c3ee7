#include "sensor/equalised_levels.h"

#include <algorithm>

namespace thermal {

std::vector<double> equalised_levels(const LevelBins& bins, std::size_t first,
                                     const std::vector<double>& shares) {
  constexpr double kLargestLevel = 255;
  double all = 0;
  for (const double share : shares) all += share;
  std::vector<double> rise(shares.size());
  double risen = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    rise[i] = std::min(bins.steepest, shares[i] * kLargestLevel / all);
    risen += rise[i];
  }
  std::vector<double> levels(bins.size() + 1, 0);
  levels[first] = 0.5 * (kLargestLevel - risen);
  for (std::size_t bin = first; bin + 1 < levels.size(); ++bin) {
    const double here = bin - first < rise.size() ? rise[bin - first] : bins.steepest;
    levels[bin + 1] = std::min(kLargestLevel, levels[bin] + here);
  }
  for (std::size_t bin = first; bin > 0 && levels[bin] > 0; --bin)
    levels[bin - 1] = std::max(0.0, levels[bin] - bins.steepest);
  return levels;
}

}  // namespace thermal
