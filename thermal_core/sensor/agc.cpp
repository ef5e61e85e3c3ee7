#include "sensor/agc.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kCounts = 65536;
constexpr double kLargestLevel = 255;
constexpr std::size_t kClipped = kCounts - 1;
constexpr double kBinK = 0.04;  // of the plateau's histogram: about a NETD
constexpr std::size_t kCountsAChunk = 65536;

std::uint16_t threshold(double count) {
  return static_cast<std::uint16_t>(std::clamp(std::ceil(count), 1.0, static_cast<double>(kClipped)));
}

/// 255 - level is level ^ 255.
std::uint8_t flip_of(Polarity polarity) { return polarity == Polarity::black_hot ? 255 : 0; }

template <typename T>
void fit_size(const Plane<T>& like, Plane<std::uint8_t>& picture) {
  if (picture.width_px() == like.width_px() && picture.height_px() == like.height_px()) return;
  picture = Plane<std::uint8_t>(like.width_px(), like.height_px());
}

/// Smallest and largest count outside the tails; low > high if nothing was measured.
std::pair<std::size_t, std::size_t> without_tails(const std::vector<std::uint32_t>& histogram,
                                                  double tail_pixels) {
  std::size_t low = 1;
  std::size_t high = kClipped - 1;
  double below = 0;
  double above = 0;
  while (low < kClipped && (below += histogram[low]) <= tail_pixels) ++low;
  while (high > 0 && (above += histogram[high]) <= tail_pixels) --high;
  return {low, high};
}

}  // namespace

Agc::Agc(const AgcParameters& parameters, AgcScene scene)
    : parameters_(parameters),
      scene_(std::move(scene)),
      share_of_new_(
          parameters.damping_s <= 0 ? 1 : -std::expm1(-1 / (scene_.frame_rate_hz * parameters.damping_s))),
      counts_per_netd_(scene_.netd_k / scene_.kelvin_per_count),
      bin_counts_(static_cast<std::size_t>(std::max(1L, std::lround(kBinK / scene_.kelvin_per_count)))) {
  curve_.thresholds.fill(static_cast<std::uint16_t>(kClipped));
  if (parameters_.mode == AgcMode::scene_max) make_radiance_curve(0.5);
  if (parameters_.mode == AgcMode::table_max) make_radiance_curve(0);
  if (parameters_.mode == AgcMode::linear) {
    make_linear_curve(parameters_.low_k / scene_.kelvin_per_count,
                      parameters_.high_k / scene_.kelvin_per_count);
  }
}

/// Level k starts at (k - rounding) / 255 of the brightest radiance, at the count to which that temperature rounds.
void Agc::make_radiance_curve(double rounding) {
  for (std::size_t level = 1; level < kLevels; ++level) {
    const double share = (static_cast<double>(level) - rounding) / kLargestLevel;
    const double temperature_k = scene_.temperature_of(share * scene_.brightest_w_m2_sr);
    curve_.thresholds[level - 1] = threshold(std::floor(temperature_k / scene_.kelvin_per_count + 0.5));
  }
  curve_.high_k = scene_.temperature_of(scene_.brightest_w_m2_sr);
}

void Agc::make_linear_curve(double low_count, double high_count) {
  for (std::size_t level = 1; level < kLevels; ++level) {
    const double share = (static_cast<double>(level) - 0.5) / kLargestLevel;
    curve_.thresholds[level - 1] = threshold(low_count + share * (high_count - low_count));
  }
  curve_.low_k = low_count * scene_.kelvin_per_count;
  curve_.high_k = high_count * scene_.kelvin_per_count;
}

const ToneCurve& Agc::next(const Plane<std::uint16_t>& ir16) {
  if (parameters_.mode != AgcMode::percentile && parameters_.mode != AgcMode::plateau) return curve_;
  histogram_.assign(kCounts, 0);
  for (const std::uint16_t count : ir16.pixels()) ++histogram_[count];
  const std::size_t measured = ir16.size() - histogram_[0] - histogram_[kClipped];
  if (measured == 0) return curve_;
  const auto [low, high] =
      without_tails(histogram_, parameters_.tail_percent / 100 * static_cast<double>(measured));
  if (parameters_.mode == AgcMode::percentile) {
    adapt_percentiles(low, high);
  } else {
    adapt_plateau(low, high, measured);
  }
  adapted_ = true;
  return curve_;
}

void Agc::adapt_percentiles(std::size_t low, std::size_t high) {
  const double middle = 0.5 * static_cast<double>(low + high);
  const double narrowest = kLargestLevel / parameters_.max_gain_dn_per_netd * counts_per_netd_;
  const double half = 0.5 * std::max(static_cast<double>(high - low), narrowest);
  const double share = adapted_ ? share_of_new_ : 1;
  low_count_ += share * (middle - half - low_count_);
  high_count_ += share * (middle + half - high_count_);
  make_linear_curve(low_count_, high_count_);
}

/// Level at the lower edge of every bin: levels rise in proportion to a bin's pixels, limited by the plateau and by
/// the largest gain. Levels left over are split between both ends, where the largest gain continues.
std::vector<double> Agc::equalised(std::size_t low, std::size_t high, std::size_t measured) const {
  const std::size_t bins = (kCounts + bin_counts_ - 1) / bin_counts_;
  const std::size_t first = low / bin_counts_;
  const std::size_t last = high / bin_counts_;
  const double plateau = std::max(1.0, parameters_.plateau_percent / 100 * static_cast<double>(measured));
  const double steepest =
      parameters_.max_gain_dn_per_netd * static_cast<double>(bin_counts_) / counts_per_netd_;
  std::vector<double> rise(bins, steepest);
  double pixels = 0;
  for (std::size_t bin = first; bin <= last; ++bin) {
    const auto begin = histogram_.begin() + static_cast<std::ptrdiff_t>(std::max(low, bin * bin_counts_));
    const auto end = histogram_.begin() +
                     static_cast<std::ptrdiff_t>(std::min(high, bin * bin_counts_ + bin_counts_ - 1)) + 1;
    rise[bin] = std::min(plateau, static_cast<double>(std::accumulate(begin, end, std::uint64_t{0})));
    pixels += rise[bin];
  }
  double risen = 0;
  for (std::size_t bin = first; bin <= last; ++bin) {
    rise[bin] = std::min(steepest, rise[bin] * kLargestLevel / pixels);
    risen += rise[bin];
  }
  std::vector<double> levels(bins + 1);
  levels[first] = 0.5 * (kLargestLevel - risen);
  for (std::size_t bin = first; bin < bins; ++bin)
    levels[bin + 1] = std::min(kLargestLevel, levels[bin] + rise[bin]);
  for (std::size_t bin = first; bin > 0; --bin) levels[bin - 1] = std::max(0.0, levels[bin] - rise[bin - 1]);
  return levels;
}

void Agc::adapt_plateau(std::size_t low, std::size_t high, std::size_t measured) {
  std::vector<double> wanted = equalised(low, high, measured);
  if (adapted_) {
    for (std::size_t i = 0; i < wanted.size(); ++i) levels_[i] += share_of_new_ * (wanted[i] - levels_[i]);
  } else {
    levels_ = std::move(wanted);
  }
  make_thresholds_of_levels();
  curve_.low_k = static_cast<double>(low) * scene_.kelvin_per_count;
  curve_.high_k = static_cast<double>(high) * scene_.kelvin_per_count;
}

void Agc::make_thresholds_of_levels() {
  std::size_t bin = 0;
  const std::size_t bins = levels_.size() - 1;
  for (std::size_t level = 1; level < kLevels; ++level) {
    const double wanted = static_cast<double>(level) - 0.5;
    while (bin < bins && levels_[bin + 1] < wanted) ++bin;
    const double share = bin < bins ? (wanted - levels_[bin]) / (levels_[bin + 1] - levels_[bin]) : 0;
    curve_.thresholds[level - 1] =
        threshold((static_cast<double>(bin) + share) * static_cast<double>(bin_counts_));
  }
}

void truncate_to_levels(const Plane<float>& radiance_w_m2_sr, double brightest_w_m2_sr, Polarity polarity,
                        Plane<std::uint8_t>& ir8) {
  fit_size(radiance_w_m2_sr, ir8);
  const double w_m2_sr_per_level = brightest_w_m2_sr / kLargestLevel;
  const std::uint8_t flip = flip_of(polarity);
  const auto in = radiance_w_m2_sr.pixels();
  const auto out = ir8.pixels();
  for (std::size_t i = 0; i < in.size(); ++i) {
    // Divided in double and rounded to single precision, so that exact levels are not rounded down.
    const auto level = static_cast<float>(static_cast<double>(in[i]) / w_m2_sr_per_level);
    const float clipped = level > 0.0F ? std::min(level, 255.0F) : 0.0F;  // NaN compares false: 0
    out[i] = static_cast<std::uint8_t>(static_cast<std::uint8_t>(clipped) ^ flip);
  }
}

void apply_tone_curve(const ToneCurve& curve, Polarity polarity, const Plane<std::uint16_t>& ir16,
                      Plane<std::uint8_t>& ir8) {
  std::vector<std::uint8_t> table(kCounts);
  const std::uint8_t flip = flip_of(polarity);
  std::size_t level = 0;
  for (std::size_t count = 0; count < kCounts; ++count) {
    while (level < curve.thresholds.size() && curve.thresholds[level] <= count) ++level;
    table[count] = static_cast<std::uint8_t>(level) ^ flip;  // 255 - level, if flipped
  }
  fit_size(ir16, ir8);
  // Plain pointers: through spans, the compiler must assume that a written byte aliases the span itself.
  const std::uint8_t* const levels = table.data();
  const std::uint16_t* const in = ir16.pixels().data();
  std::uint8_t* const out = ir8.pixels().data();
  parallel_for(ir16.size(), kCountsAChunk, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) out[i] = levels[in[i]];
  });
}

}  // namespace thermal
