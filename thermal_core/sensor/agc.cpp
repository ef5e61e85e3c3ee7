#include "sensor/agc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kMarkedRowsPerChunk = 32;

VELDT_INLINE std::int32_t size_of(std::int32_t difference) {
  return difference < 0 ? -difference : difference;
}

/// One row, from columns `begin` to `end`, whose neighbours are `left` and `right` columns away.
VELDT_CLONES void mark_columns(const std::uint16_t* up, const std::uint16_t* here, const std::uint16_t* down,
                               std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t left,
                               std::ptrdiff_t right, std::int32_t threshold, std::uint8_t* marks) {
  for (std::ptrdiff_t x = begin; x < end; ++x) {
    const std::int32_t before = up[x - left] + here[x - left] + down[x - left];
    const std::int32_t after = up[x + right] + here[x + right] + down[x + right];
    const std::int32_t above = up[x - left] + up[x] + up[x + right];
    const std::int32_t below = down[x - left] + down[x] + down[x + right];
    const std::int32_t across = size_of(after - before);
    const std::int32_t along = size_of(below - above);
    marks[x] = static_cast<std::uint8_t>((across > along ? across : along) > threshold);
  }
}

void mark_row(const Plane<std::uint16_t>& ir16, int y, std::int32_t threshold, std::uint8_t* marks) {
  const std::uint16_t* const up = ir16.row(std::max(y - 1, 0)).data();
  const std::uint16_t* const here = ir16.row(y).data();
  const std::uint16_t* const down = ir16.row(std::min(y + 1, ir16.height_px() - 1)).data();
  const std::ptrdiff_t width = ir16.width_px();
  const std::ptrdiff_t last = width - 1;
  mark_columns(up, here, down, 0, 1, 0, last > 0 ? 1 : 0, threshold, marks);
  if (last > 0) mark_columns(up, here, down, last, width, 1, 0, threshold, marks);
  mark_columns(up, here, down, 1, last, 1, 1, threshold, marks);
}

}  // namespace

void mark_information(const Plane<std::uint16_t>& ir16, double threshold_counts, Plane<std::uint8_t>& marks) {
  marks.resize(ir16.width_px(), ir16.height_px());
  constexpr double kLargestSum = 3 * 65535;
  const auto threshold = static_cast<std::int32_t>(std::min(kLargestSum, std::floor(3 * threshold_counts)));
  parallel_rows(ir16.height_px(), kMarkedRowsPerChunk,
                [&](int y) { mark_row(ir16, y, threshold, marks.row(y).data()); });
}

namespace {

constexpr std::size_t kCounts = 65536;
constexpr double kLargestLevel = 255;
constexpr std::size_t kClipped = kCounts - 1;
constexpr double kBinK = 0.04;  // of the plateau's histogram: about a NETD
constexpr std::size_t kCountsPerChunk = 65536;

std::uint16_t threshold(double count) {
  return static_cast<std::uint16_t>(std::clamp(std::ceil(count), 1.0, static_cast<double>(kClipped)));
}

/// 255 - level is level ^ 255.
std::uint8_t flip_of(Polarity polarity) { return polarity == Polarity::black_hot ? 255 : 0; }

LevelBins bins_of(const AgcParameters& parameters, const AgcScene& scene) {
  const auto counts = static_cast<std::size_t>(std::max(1L, std::lround(kBinK / scene.kelvin_per_count)));
  const double counts_per_netd = scene.netd_k / scene.kelvin_per_count;
  return {.counts = counts,
          .steepest = parameters.max_gain_dn_per_netd * static_cast<double>(counts) / counts_per_netd};
}

bool is_adaptive(AgcMode mode) {
  return mode == AgcMode::percentile || mode == AgcMode::plateau || mode == AgcMode::information;
}

}  // namespace

Agc::Agc(const AgcParameters& parameters, AgcScene scene)
    : parameters_(parameters),
      scene_(std::move(scene)),
      share_of_new_(
          parameters.damping_s <= 0 ? 1 : -std::expm1(-1 / (scene_.frame_rate_hz * parameters.damping_s))),
      counts_per_netd_(scene_.netd_k / scene_.kelvin_per_count),
      bins_(bins_of(parameters, scene_)) {
  curve_.thresholds.fill(static_cast<std::uint16_t>(kClipped));
  if (parameters_.mode == AgcMode::scene_max) make_radiance_curve(0.5);
  if (parameters_.mode == AgcMode::table_max) make_radiance_curve(0);
  if (parameters_.mode == AgcMode::linear) {
    make_linear_curve(parameters_.low_k / scene_.kelvin_per_count,
                      parameters_.high_k / scene_.kelvin_per_count);
  }
  if (parameters_.mode == AgcMode::clahe) {
    local_.emplace(parameters_, bins_, share_of_new_);
    curve_.is_local = true;
  }
}

/// Level k starts at (k - rounding) / 255 of the brightest radiance, at the rounded count of that temperature.
void Agc::make_radiance_curve(double rounding) {
  for (std::size_t level = 1; level < kLevels; ++level) {
    const double share = (static_cast<double>(level) - rounding) / kLargestLevel;
    const double temperature_k = scene_.temperature_of(share * scene_.brightest_w_m2_sr);
    curve_.thresholds[level - 1] = threshold(std::floor(temperature_k / scene_.kelvin_per_count + 0.5));
  }
  curve_.high_k = scene_.temperature_of(scene_.brightest_w_m2_sr);
  keep_headroom();
}

void Agc::make_linear_curve(double low_count, double high_count) {
  for (std::size_t level = 1; level < kLevels; ++level) {
    const double share = (static_cast<double>(level) - 0.5) / kLargestLevel;
    curve_.thresholds[level - 1] = threshold(low_count + share * (high_count - low_count));
  }
  curve_.low_k = low_count * scene_.kelvin_per_count;
  curve_.high_k = high_count * scene_.kelvin_per_count;
  keep_headroom();
}

/// Maps levels 0 to 255 to the range from black to white, to the nearest.
void Agc::keep_headroom() {
  if (parameters_.mode == AgcMode::table_max ||
      (parameters_.black_level == 0 && parameters_.white_level == 255))
    return;
  const auto full = curve_.thresholds;
  const auto level_of = [this](std::size_t level) {
    return level_within(static_cast<std::uint8_t>(level), parameters_.black_level, parameters_.white_level);
  };
  std::size_t level = 0;
  for (std::size_t shown = 1; shown < kLevels; ++shown) {
    while (level < kLevels && level_of(level) < shown) ++level;
    curve_.thresholds[shown - 1] = level == 0        ? std::uint16_t{1}
                                   : level < kLevels ? full[level - 1]
                                                     : static_cast<std::uint16_t>(kClipped);
  }
}

const ToneCurve& Agc::next(const Plane<std::uint16_t>& ir16) {
  if (local_) adapt_locally(ir16);
  if (!is_adaptive(parameters_.mode)) return curve_;
  histogram_.assign(kCounts, 0);
  for (const std::uint16_t count : ir16.pixels()) ++histogram_[count];
  const std::size_t measured = ir16.size() - histogram_[0] - histogram_[kClipped];
  if (measured == 0) return curve_;
  const auto [first, last] = between_tails(std::span(histogram_).subspan(1, kClipped - 1),
                                           parameters_.tail_percent / 100 * static_cast<double>(measured));
  const std::size_t low = first + 1;
  const std::size_t high = last + 1;
  if (parameters_.mode == AgcMode::percentile) {
    adapt_percentiles(low, high);
  } else {
    count_information(ir16);
    adapt_plateau(low, high, measured);
  }
  adapted_ = true;
  return curve_;
}

void Agc::show(const Plane<std::uint16_t>& ir16, Plane<std::uint8_t>& ir8) const {
  if (!local_) {
    apply_tone_curve(curve_, parameters_.polarity, ir16, ir8);
    return;
  }
  ir8.resize(ir16.width_px(), ir16.height_px());
  local_->show(ir16, ir8);
  const std::uint8_t flip = flip_of(parameters_.polarity);
  for (std::uint8_t& level : ir8.pixels()) level = static_cast<std::uint8_t>(level ^ flip);
}

void Agc::adapt_locally(const Plane<std::uint16_t>& ir16) {
  local_->adapt(ir16);
  curve_.low_k = static_cast<double>(local_->range().low) * scene_.kelvin_per_count;
  curve_.high_k = static_cast<double>(local_->range().high) * scene_.kelvin_per_count;
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

/// For mode information; for plateau, all pixels count alike.
void Agc::count_information(const Plane<std::uint16_t>& ir16) {
  if (parameters_.mode != AgcMode::information) return;
  mark_information(ir16, parameters_.information_threshold_netd * counts_per_netd_, marks_);
  informed_.assign(kCounts, 0);
  for (std::size_t i = 0; i < ir16.size(); ++i) informed_[ir16.pixels()[i]] += marks_.pixels()[i];
}

/// Number of pixels with counts in [begin, end); in mode information, flat ones have less weight.
double Agc::weight_of(std::size_t begin, std::size_t end) const {
  const auto sum = [&](const Histogram& histogram) {
    const auto at = [&](std::size_t count) { return histogram.begin() + static_cast<std::ptrdiff_t>(count); };
    return static_cast<double>(std::accumulate(at(begin), at(end), std::uint64_t{0}));
  };
  const double all = sum(histogram_);
  if (parameters_.mode != AgcMode::information) return all;
  const double informed = sum(informed_);
  return informed + parameters_.flat_weight * (all - informed);
}

/// Level at the lower edge of every bin: levels rise in proportion to a bin's pixels, limited by the plateau, mixed with a
/// straight line, and limited by the largest gain.
std::vector<double> Agc::equalised(std::size_t low, std::size_t high, std::size_t measured) const {
  const std::size_t width = bins_.counts;
  const bool weighted = parameters_.mode == AgcMode::information;
  const double all = weighted ? weight_of(1, kClipped) : static_cast<double>(measured);
  const double plateau = std::max(weighted ? 0.0 : 1.0, parameters_.plateau_percent / 100 * all);
  std::vector<double> shares;
  for (std::size_t bin = low / width; bin <= high / width; ++bin) {
    const std::size_t begin = std::max(low, bin * width);
    const std::size_t end = std::min(high, bin * width + width - 1) + 1;
    shares.push_back(std::min(plateau, weight_of(begin, end)));
  }
  if (parameters_.linear_percent > 0) {
    const double straight = parameters_.linear_percent / 100;
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares)
      share = (1 - straight) * share / sum + straight / static_cast<double>(shares.size());
  }
  return equalised_levels(bins_, low / width, shares);
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
        threshold((static_cast<double>(bin) + share) * static_cast<double>(bins_.counts));
  }
  keep_headroom();
}

void truncate_to_levels(const Plane<float>& radiance_w_m2_sr, double brightest_w_m2_sr, Polarity polarity,
                        Plane<std::uint8_t>& ir8) {
  ir8.resize(radiance_w_m2_sr.width_px(), radiance_w_m2_sr.height_px());
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
  ir8.resize(ir16.width_px(), ir16.height_px());
  // Plain pointers: through spans, the compiler must assume that a written byte aliases the span itself.
  const std::uint8_t* const levels = table.data();
  const std::uint16_t* const in = ir16.pixels().data();
  std::uint8_t* const out = ir8.pixels().data();
  parallel_for(ir16.size(), kCountsPerChunk, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) out[i] = levels[in[i]];
  });
}

}  // namespace thermal
