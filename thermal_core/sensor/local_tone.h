#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/image.h"
#include "sensor/sensor_parameters.h"

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

/// Contrast-limited adaptive histogram equalisation (Zuiderveld, Graphics Gems IV, 1994): each tile of the picture has
/// a tone curve of its own, and a pixel's level is interpolated bilinearly between those of the four nearest tiles.
///
/// Our own kernel: cv::CLAHE has a bin for each of 65,536 counts, of which a night uses 3000, so that its clip limit is
/// a whole pixel or none; it cannot limit the gain in counts per NETD; and `veldt::core`, which has the sensor, needs
/// no OpenCV.
class LocalTone {
 public:
  /// Counts of the whole frame between the tails.
  struct Range {
    std::size_t low = 0;
    std::size_t high = 0;
  };

  /// @param share_of_new  weight of a frame's own curves; the rest is the previous curves
  LocalTone(const AgcParameters& parameters, const LevelBins& bins, double share_of_new);

  /// Updates the curves with the next frame. Counts 0 and 65535 are ignored; a tile without any other takes the frame's
  /// curve. A frame without any other changes nothing; before the first one that has some, pictures are black.
  void adapt(const Plane<std::uint16_t>& ir16);

  /// The 8-bit frame, white-hot. Count 0 shows as 0 and 65535 as 255.
  void show(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8) const;

  [[nodiscard]] const Range& range() const noexcept { return range_; }

 private:
  using Histogram = std::vector<std::uint32_t>;  ///< by bin

  /// Two tiles around a coordinate, and the weight of the second.
  struct Between {
    std::size_t first = 0;
    std::size_t second = 0;
    float share = 0;
  };

  void count(const Plane<std::uint16_t>& ir16);
  [[nodiscard]] std::vector<double> levels_of(const Histogram& histogram) const;
  void follow(const std::vector<double>& wanted, float* levels) const;
  void show_row(const Plane<std::uint16_t>& ir16, int y, const std::vector<Between>& columns,
                Plane<std::uint8_t>& ir8) const;
  [[nodiscard]] static Between between(int at_px, int size_px, std::size_t tiles);

  AgcParameters parameters_;
  LevelBins bins_;
  double share_of_new_;
  std::size_t across_ = 1;  ///< tiles
  std::size_t down_ = 1;
  bool adapted_ = false;
  Range range_;
  std::vector<Histogram> histograms_;  ///< of tiles, row by row
  std::vector<float> levels_;          ///< bins_.size() + 1 for each tile
};

}  // namespace thermal
