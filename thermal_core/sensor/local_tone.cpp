#include "sensor/local_tone.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

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

namespace {

constexpr std::uint16_t kSaturatedCount = 65535;
constexpr std::size_t kToneRowsPerChunk = 16;

/// First pixel of a tile, of `tiles` over `size_px` pixels.
int tile_begin(std::size_t tile, std::size_t tiles, int size_px) {
  return static_cast<int>(tile * static_cast<std::size_t>(size_px) / tiles);
}

std::uint64_t pixels_in(const std::vector<std::uint32_t>& histogram) {
  std::uint64_t sum = 0;
  for (const std::uint32_t pixels : histogram) sum += pixels;
  return sum;
}

float mixed(float one, float other, float share) { return one + share * (other - one); }

/// Level at a position within a bin, from the levels of its edges.
float level_at(const float* edges, float share) { return mixed(edges[0], edges[1], share); }

}  // namespace

LocalTone::LocalTone(const AgcParameters& parameters, const LevelBins& bins, double share_of_new)
    : parameters_(parameters), bins_(bins), share_of_new_(share_of_new) {}

void LocalTone::adapt(const Plane<std::uint16_t>& ir16) {
  across_ = static_cast<std::size_t>(std::min(parameters_.tiles_across, ir16.width_px()));
  down_ = static_cast<std::size_t>(std::min(parameters_.tiles_down, ir16.height_px()));
  const std::size_t edges = bins_.size() + 1;
  levels_.resize(across_ * down_ * edges);
  count(ir16);
  Histogram all(bins_.size());
  for (const Histogram& tile : histograms_)
    for (std::size_t bin = 0; bin < all.size(); ++bin) all[bin] += tile[bin];
  const std::uint64_t measured = pixels_in(all);
  if (measured == 0) return;
  const double tail_pixels = parameters_.tail_percent / 100 * static_cast<double>(measured);
  const auto [low, high] = between_tails(all, tail_pixels);
  range_ = {.low = low * bins_.counts, .high = (high + 1) * bins_.counts};
  const std::vector<double> of_frame = levels_of(all);
  parallel_for(histograms_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      const bool is_empty = pixels_in(histograms_[tile]) == 0;
      follow(is_empty ? of_frame : levels_of(histograms_[tile]), &levels_[tile * edges]);
    }
  });
  adapted_ = true;
}

void LocalTone::count(const Plane<std::uint16_t>& ir16) {
  histograms_.resize(across_ * down_);
  parallel_for(histograms_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      Histogram& histogram = histograms_[tile];
      histogram.assign(bins_.size(), 0);
      const std::size_t column = tile % across_;
      const std::size_t row = tile / across_;
      const auto x = static_cast<std::size_t>(tile_begin(column, across_, ir16.width_px()));
      const auto width = static_cast<std::size_t>(tile_begin(column + 1, across_, ir16.width_px())) - x;
      for (int y = tile_begin(row, down_, ir16.height_px()); y < tile_begin(row + 1, down_, ir16.height_px());
           ++y) {
        for (const std::uint16_t count : ir16.row(y).subspan(x, width))
          if (count != 0 && count != kSaturatedCount) ++histogram[count / bins_.counts];
      }
    }
  });
}

/// Pixels of a bin above the clip limit are spread evenly over the tile's range, as in Zuiderveld's algorithm.
std::vector<double> LocalTone::levels_of(const Histogram& histogram) const {
  const auto measured = static_cast<double>(pixels_in(histogram));
  const auto [low, high] = between_tails(histogram, parameters_.tail_percent / 100 * measured);
  std::vector<double> shares(high - low + 1);
  const auto bins = static_cast<double>(shares.size());
  double kept = 0;
  for (std::size_t bin = low; bin <= high; ++bin) kept += histogram[bin];
  const double limit = parameters_.clip_limit * kept / bins;
  double clipped = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = std::min(limit, static_cast<double>(histogram[low + i]));
    clipped += shares[i];
  }
  for (double& share : shares) share += (kept - clipped) / bins;
  return equalised_levels(bins_, low, shares);
}

void LocalTone::follow(const std::vector<double>& wanted, float* levels) const {
  const auto share = static_cast<float>(adapted_ ? share_of_new_ : 1);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto target = static_cast<float>(wanted[i]);
    levels[i] = share < 1 ? levels[i] + share * (target - levels[i]) : target;
  }
}

LocalTone::Between LocalTone::between(int at_px, int size_px, std::size_t tiles) {
  const double in_tiles = (at_px + 0.5) * static_cast<double>(tiles) / size_px - 0.5;
  const double first = std::clamp(std::floor(in_tiles), 0.0, static_cast<double>(tiles - 1));
  const auto index = static_cast<std::size_t>(first);
  return {.first = index,
          .second = std::min(index + 1, tiles - 1),
          .share = static_cast<float>(std::clamp(in_tiles - first, 0.0, 1.0))};
}

void LocalTone::show(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8) const {
  std::vector<Between> columns;
  for (int x = 0; x < ir16.width_px(); ++x) columns.push_back(between(x, ir16.width_px(), across_));
  parallel_rows(ir16.height_px(), kToneRowsPerChunk, [&](int y) { show_row(ir16, y, columns, ir8); });
}

void LocalTone::show_row(const Plane<std::uint16_t>& ir16, int y, const std::vector<Between>& columns,
                         Plane<std::uint8_t>& ir8) const {
  const std::size_t edges = bins_.size() + 1;
  const Between rows = between(y, ir16.height_px(), down_);
  const float* const upper = &levels_[rows.first * across_ * edges];
  const float* const lower = &levels_[rows.second * across_ * edges];
  const auto bins_per_count = static_cast<float>(1 / static_cast<double>(bins_.counts));
  const std::uint16_t* const in = ir16.row(y).data();
  std::uint8_t* const out = ir8.row(y).data();
  for (std::size_t x = 0; x < columns.size(); ++x) {
    const Between& column = columns[x];
    const std::size_t bin = in[x] / bins_.counts;
    const float share = bins_per_count * static_cast<float>(in[x] - bin * bins_.counts);
    const std::size_t left = column.first * edges + bin;
    const std::size_t right = column.second * edges + bin;
    const float above = mixed(level_at(upper + left, share), level_at(upper + right, share), column.share);
    const float below = mixed(level_at(lower + left, share), level_at(lower + right, share), column.share);
    const float rounded = 0.5F + mixed(above, below, rows.share);
    const auto level = level_within(static_cast<std::uint8_t>(static_cast<std::int32_t>(rounded)),
                                    parameters_.black_level, parameters_.white_level);
    out[x] = in[x] == 0 ? 0 : in[x] == kSaturatedCount ? 255 : level;
  }
}

}  // namespace thermal
