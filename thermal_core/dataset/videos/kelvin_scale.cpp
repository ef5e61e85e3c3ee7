#include "dataset/videos/kelvin_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Temperatures are multiples of this while ticks are chosen, so that sums are exact.
constexpr double kUnitsPerKelvin = 100;
constexpr long kWidestUnits = 100'000;  // 1000 K

/// Chooses ticks by dividing intervals while all parts are wide enough.
class TickFinder {
 public:
  TickFinder(const KelvinScale& scale, double least_gap)
      : scale_(scale), least_gap_(least_gap), known_(scale.known()) {}

  std::vector<ScaleTick> find() {
    const auto first = static_cast<long>(std::floor(known_.low_k * kUnitsPerKelvin / kWidestUnits));
    const auto last = static_cast<long>(std::ceil(known_.high_k * kUnitsPerKelvin / kWidestUnits));
    for (long k = first; k < last; ++k) {
      add(k * kWidestUnits);
      divide(k * kWidestUnits, kWidestUnits, 1);
    }
    std::ranges::sort(ticks_, {}, &ScaleTick::position);
    return std::move(ticks_);
  }

 private:
  [[nodiscard]] std::optional<double> position_of(long units) const {
    return scale_.position_of(static_cast<double>(units) / kUnitsPerKelvin);
  }

  void add(long units) {
    const std::optional<double> position = position_of(units);
    const double temperature_k = static_cast<double>(units) / kUnitsPerKelvin;
    if (position) ticks_.push_back({temperature_k, *position, fmt::format("{:g}", temperature_k)});
  }

  [[nodiscard]] bool fits(long from, long width, long parts) const {
    std::optional<double> before;
    for (long k = 0; k <= parts; ++k) {
      const std::optional<double> here = position_of(from + k * width / parts);
      if (before && here && *here - *before < least_gap_) return false;
      before = here;
    }
    return true;
  }

  [[nodiscard]] bool is_free(long units) const {
    const std::optional<double> position = position_of(units);
    return position && std::ranges::none_of(ticks_, [&](const ScaleTick& tick) {
             return std::abs(tick.position - *position) < least_gap_;
           });
  }

  /// Whether both ends are on the scale.
  [[nodiscard]] bool is_inside(long from, long width) const {
    return position_of(from).has_value() && position_of(from + width).has_value();
  }

  /// `leading`: the first digit of the width, 1, 2 or 5. Divides into as many parts as fit or, where the scale is
  /// nonlinear, adds only ticks far enough from others.
  void divide(long from, long width, long leading) {
    const double low_k = static_cast<double>(from) / kUnitsPerKelvin;
    const double high_k = static_cast<double>(from + width) / kUnitsPerKelvin;
    if (high_k <= known_.low_k || low_k >= known_.high_k) return;
    const std::vector<long> choices =
        leading == 1 ? std::vector{10L, 5L, 2L} : std::vector{2 * leading, leading};
    for (const long parts : choices) {
      if (width % parts == 0 && fits(from, width, parts)) return divide_into(parts, from, width, leading);
    }
    if (is_inside(from, width) && *position_of(from + width) - *position_of(from) > least_gap_)
      add_single(choices, from, width, leading);
  }

  void add_single(const std::vector<long>& choices, long from, long width, long leading) {
    const std::vector<long> ascending(choices.rbegin(), choices.rend());
    for (const long parts : ascending) {
      for (long k = 1; width % parts == 0 && k < parts; ++k) {
        if (is_free(from + k * width / parts)) add(from + k * width / parts);
      }
    }
    if (width % choices.front() != 0) return;
    const long step = width / choices.front();
    for (long k = 0; k < choices.front(); ++k) divide(from + k * step, step, leading == 1 ? 1 : 5);
  }

  void divide_into(long parts, long from, long width, long leading) {
    const long step = width / parts;
    for (long k = 1; k < parts; ++k) add(from + k * step);
    const long next = leading == 1 ? 10 / parts : parts == leading ? 1 : 5;
    for (long k = 0; k < parts; ++k) divide(from + k * step, step, next);
  }

  const KelvinScale& scale_;
  double least_gap_;
  KelvinRange known_;
  std::vector<ScaleTick> ticks_;
};

}  // namespace

KelvinRange parse_kelvin_range(std::string_view text) {
  const std::vector<std::string_view> ends = split(text, ':');
  if (ends.size() == 2) {
    const std::optional<double> low_k = number_in<double>(ends[0]);
    const std::optional<double> high_k = number_in<double>(ends[1]);
    constexpr double kMost = 10'000;
    if (low_k && high_k && *low_k >= 0 && *low_k < *high_k && *high_k <= kMost) return {*low_k, *high_k};
  }
  throw ConfigError(fault("--range", fmt::format("\"{}\"", text), "",
                          "LO:HI in kelvin, 0 <= LO < HI <= 10000, such as 270:300"));
}

std::optional<double> KelvinScale::position_of(double temperature_k) const {
  const auto above = std::ranges::upper_bound(edges_k, temperature_k);
  if (above == edges_k.begin()) return std::nullopt;
  const double from = *(above - 1);
  const auto level = static_cast<double>(above - edges_k.begin() - 1);
  if (from == temperature_k) return level / kLevels;
  if (above == edges_k.end() || !std::isfinite(from) || !std::isfinite(*above)) return std::nullopt;
  return (level + (temperature_k - from) / (*above - from)) / kLevels;
}

KelvinRange KelvinScale::known() const {
  const auto finite = [](double edge_k) { return std::isfinite(edge_k); };
  const auto first = std::ranges::find_if(edges_k, finite);
  if (first == edges_k.end()) return {};
  return {.low_k = *first, .high_k = *std::find_if(edges_k.rbegin(), edges_k.rend(), finite)};
}

KelvinScale scale_of_curve(const std::array<std::uint16_t, kLevels - 1>& thresholds,
                           double kelvin_per_count) {
  constexpr std::uint16_t kLeastMeasured = 1;
  constexpr std::uint16_t kNever = 65535;
  KelvinScale scale;
  scale.edges_k.front() = -kInfinity;
  scale.edges_k.back() = kInfinity;
  std::ranges::transform(thresholds, scale.edges_k.begin() + 1, [&](std::uint16_t count) {
    if (count <= kLeastMeasured) return -kInfinity;
    return count == kNever ? kInfinity : count * kelvin_per_count;
  });
  return scale;
}

KelvinScale linear_scale(const KelvinRange& range) {
  KelvinScale scale;
  for (std::size_t k = 0; k < scale.edges_k.size(); ++k)
    scale.edges_k[k] = range.low_k + (range.high_k - range.low_k) * static_cast<double>(k) / kLevels;
  return scale;
}

std::vector<std::uint8_t> levels_of_counts(const KelvinScale& scale, double kelvin_per_count) {
  constexpr std::size_t kCounts = 65536;
  std::vector<std::uint8_t> levels(kCounts);
  std::size_t level = 0;
  for (std::size_t count = 0; count < kCounts; ++count) {
    const double temperature_k = static_cast<double>(count) * kelvin_per_count;
    while (level + 1 < kLevels && scale.edges_k[level + 1] <= temperature_k) ++level;
    levels[count] = static_cast<std::uint8_t>(level);
  }
  return levels;
}

std::vector<ScaleTick> ticks_of(const KelvinScale& scale, double least_gap) {
  return TickFinder(scale, least_gap).find();
}

}  // namespace thermal
