#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace thermal {

/// Bins of a histogram of 16-bit counts, and the steepest rise of levels over them.
struct LevelBins {
  std::size_t counts = 1;  ///< counts per bin
  double steepest = 255;   ///< levels per bin, at most

  /// Bins that hold all counts from 0 to 65535.
  [[nodiscard]] std::size_t size() const noexcept { return (65536 + counts - 1) / counts; }
};

/// Maps a level from 0 to 255 to the range from black to white, to the nearest.
[[nodiscard]] constexpr std::uint8_t level_within(std::uint8_t level, int black_level,
                                                  int white_level) noexcept {
  return static_cast<std::uint8_t>(black_level + (level * (white_level - black_level) + 127) / 255);
}

/// First and last bin outside the tails of a histogram: a tail is the bins that hold no more than `tail_pixels`
/// together, less than half of all pixels. The histogram is not empty.
[[nodiscard]] std::pair<std::size_t, std::size_t> between_tails(std::span<const std::uint32_t> histogram,
                                                                double tail_pixels);

/// Levels 0 to 255 at the lower edge of every bin, and at the end of the last: they rise in proportion to `shares` over
/// the bins from `first` on, but nowhere more steeply than `bins` allows. Levels left over are split between both ends,
/// with the steepest rise.
/// @param shares  of the bins first, first + 1, …; >= 0, not all 0
[[nodiscard]] std::vector<double> equalised_levels(const LevelBins& bins, std::size_t first,
                                                   const std::vector<double>& shares);

}  // namespace thermal
