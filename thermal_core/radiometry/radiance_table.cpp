#include "radiometry/radiance_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kTemperaturesABlock = 256;
constexpr std::size_t kKnotsPerChunk = 16;

/// The reference is evaluated at every fourth node; ln L is a cubic in between.
constexpr std::size_t kNodesAKnot = 4;
constexpr double kKnotSpacingK = static_cast<double>(kNodesAKnot) / RadianceTable::kNodesPerKelvin;

/// Bound of what the cubics add to the relative error: h^4 / 384 times the fourth derivative of ln L, which is at most
/// 24 x / T^4 at one wavelength, x = c2 / (wavelength T), and (x_1 - x_2)^4 / (8 T^4) where both ends of a band have
/// equal weight: 4e-8 for h = 1/4 K, T = 180 K and x to 80 (1 um).
constexpr double kKnotError = 4e-8;

/// Radiance at a share of the way from one knot to the next.
double between(const BandValue& below, const BandValue& above, double share) noexcept {
  const double rise = above.ln_radiance - below.ln_radiance;
  const double from_below = kKnotSpacingK * below.derivative_w_m2_sr_k / below.radiance_w_m2_sr - rise;
  const double from_above = rise - kKnotSpacingK * above.derivative_w_m2_sr_k / above.radiance_w_m2_sr;
  const double bend = share * (1 - share) * ((1 - share) * from_below + share * from_above);
  return below.radiance_w_m2_sr * std::exp(share * rise + bend);
}

}  // namespace

RadianceTable::RadianceTable(BandRadiance band) : band_(std::move(band)) {
  std::vector<BandValue> knots(kSteps / kNodesAKnot + 1);
  parallel_for(knots.size(), kKnotsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t knot = begin; knot < end; ++knot)
      knots[knot] = band_.evaluate(node_k(static_cast<double>(knot * kNodesAKnot)));
  });
  // Nodes and the middles between them, in turn.
  std::vector<double> radiance(2 * kSteps + 1);
  constexpr std::size_t kHalvesAKnot = 2 * kNodesAKnot;
  for (std::size_t half = 0; half < radiance.size() - 1; ++half) {
    const double share = static_cast<double>(half % kHalvesAKnot) / kHalvesAKnot;
    const BandValue& below = knots[half / kHalvesAKnot];
    const BandValue& above = knots[half / kHalvesAKnot + 1];
    const bool is_normal = std::isnormal(below.radiance_w_m2_sr);
    radiance[half] =
        is_normal ? between(below, above, share) : band_.radiance(node_k(static_cast<double>(half) / 2));
  }
  radiance.back() = knots.back().radiance_w_m2_sr;
  nodes_.reserve(kSteps);
  for (std::size_t node = 0; node < kSteps; ++node) {
    const double here = radiance[2 * node];
    nodes_.push_back({static_cast<float>(here), static_cast<float>(radiance[2 * node + 2] - here)});
  }
  measure(radiance);
}

void RadianceTable::measure(const std::vector<double>& radiance) {
  // Radiance is convex, so a straight line between nodes errs most at the middle. Node and result are floats, each off
  // by half an eps at most; so are, relative to the step, the step and the part of it that is added.
  constexpr double kRounding = static_cast<double>(std::numeric_limits<float>::epsilon()) / 2;
  for (std::size_t node = 0; node < kSteps; ++node) {
    const double here = radiance[2 * node];
    const double next = radiance[2 * node + 2];
    const double departure = (here + next) / 2 - radiance[2 * node + 1];
    const double error = departure + kKnotError * next + 2 * kRounding * (next + (next - here));
    worst_error_k_ = std::max(worst_error_k_, error / ((next - here) * kNodesPerKelvin));
    worst_relative_error_ = std::max(worst_relative_error_, error / here);
  }
}

float RadianceTable::outside(float temperature_k) const noexcept {
  return static_cast<float>(band_.radiance(static_cast<double>(temperature_k)));
}

double RadianceTable::relative_error_bound(double temperature_k) const noexcept {
  using Float = std::numeric_limits<float>;
  if (temperature_k <= 0) return 0;
  const auto kept_k = static_cast<float>(temperature_k);
  const auto kept = static_cast<double>(radiance(kept_k));
  if (kept == 0) return 1;
  // The ratio's own error is twice the reference's; its bound hardly changes from one float to the next.
  const double moved =
      std::abs(band_.radiance(static_cast<double>(kept_k)) / band_.radiance(temperature_k) - 1);
  const bool is_normal = kept >= static_cast<double>(Float::min());
  const double rounding =
      is_normal ? static_cast<double>(Float::epsilon()) / 2 : static_cast<double>(Float::denorm_min()) / kept;
  const double own = is_inside(kept_k) ? worst_relative_error_ : rounding;
  return (1 + own) * (1 + moved) - 1 + 4 * band_.relative_error_bound(temperature_k);
}

void RadianceTable::radiances(std::span<const float> temperature_k,
                              std::span<float> radiance_w_m2_sr) const noexcept {
  assert(temperature_k.size() == radiance_w_m2_sr.size());
  for (std::size_t begin = 0; begin < temperature_k.size(); begin += kTemperaturesABlock) {
    const auto in = temperature_k.subspan(begin, std::min(kTemperaturesABlock, temperature_k.size() - begin));
    const auto out = radiance_w_m2_sr.subspan(begin, in.size());
    bool all_inside = true;
    for (const float value : in) all_inside &= is_inside(value);
    if (all_inside) {  // nearly always, and then without a branch a pixel
      for (std::size_t i = 0; i < in.size(); ++i) out[i] = between_nodes(in[i]);
      continue;
    }
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = radiance(in[i]);
  }
}

namespace {

constexpr int kSteps = 8192;
constexpr std::size_t kRadiancesABlock = 256;
constexpr std::size_t kRadianceNodesPerChunk = 128;

struct Nodes {
  float low_w_m2_sr;
  float nodes_per_w_m2_sr;
};

/// Position between nodes of each radiance; false if one is outside, which then counts as at the first node.
VELDT_CLONES bool find_nodes(const Nodes& nodes, const float* radiances, std::size_t count,
                             std::int32_t* node, float* share) noexcept {
  constexpr auto kLast = static_cast<float>(kSteps);
  std::int32_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float position = (radiances[i] - nodes.low_w_m2_sr) * nodes.nodes_per_w_m2_sr;
    const float clamped = position >= 0.0F && position <= kLast ? position : 0.0F;
    outside |= clamped == position ? 0 : 1;  // NaN is not
    node[i] = static_cast<std::int32_t>(clamped);
    share[i] = clamped - static_cast<float>(node[i]);
  }
  return outside == 0;
}

}  // namespace

/// Nodes at floats whose last bits are 0: an octave of radiance has 1024, equally spaced within it. The node and the
/// position after it are bits of the radiance itself, without a logarithm and without rounding.
class TemperatureTable::HotPart {
 public:
  HotPart(float low_w_m2_sr, float high_w_m2_sr)
      : first_(std::bit_cast<std::uint32_t>(low_w_m2_sr) >> kShareBits),
        low_w_m2_sr_(low_w_m2_sr),
        high_w_m2_sr_(high_w_m2_sr) {}

  [[nodiscard]] bool holds(float radiance_w_m2_sr) const noexcept {
    return radiance_w_m2_sr > low_w_m2_sr_ && radiance_w_m2_sr <= high_w_m2_sr_;  // NaN is not
  }

  /// `radiance_w_m2_sr` must be within it.
  [[nodiscard]] float temperature_k(float radiance_w_m2_sr, const Inverse& inverse) {
    std::call_once(made_, [&] { make(inverse); });
    const auto bits = std::bit_cast<std::uint32_t>(radiance_w_m2_sr);
    const std::uint32_t node = (bits >> kShareBits) - first_;
    constexpr float kShareOfBit = 1.0F / (1U << kShareBits);
    const float share = static_cast<float>(bits & ((1U << kShareBits) - 1)) * kShareOfBit;
    return nodes_k_[node] + share * (nodes_k_[node + 1] - nodes_k_[node]);
  }

 private:
  static constexpr int kShareBits = 13;  // of the 23 that a float has within an octave

  void make(const Inverse& inverse) {
    const std::uint32_t last = (std::bit_cast<std::uint32_t>(high_w_m2_sr_) >> kShareBits) + 1;
    for (std::uint32_t node = first_; node <= last; ++node) {
      const auto radiance = std::bit_cast<float>(node << kShareBits);
      nodes_k_.push_back(static_cast<float>(inverse(static_cast<double>(radiance))));
    }
  }

  std::uint32_t first_;
  float low_w_m2_sr_;
  float high_w_m2_sr_;
  std::once_flag made_;
  std::vector<float> nodes_k_;
};

TemperatureTable::~TemperatureTable() = default;

TemperatureTable::TemperatureTable(Inverse inverse, double low_w_m2_sr, double high_w_m2_sr,
                                   double hottest_w_m2_sr)
    : inverse_(std::move(inverse)),
      low_w_m2_sr_(static_cast<float>(low_w_m2_sr)),
      nodes_per_w_m2_sr_(static_cast<float>(kSteps / (high_w_m2_sr - low_w_m2_sr))),
      last_position_(static_cast<float>(kSteps)) {
  assert(0 < low_w_m2_sr && low_w_m2_sr < high_w_m2_sr);
  if (hottest_w_m2_sr > high_w_m2_sr) {
    hot_ = std::make_unique<HotPart>(std::nextafter(static_cast<float>(high_w_m2_sr), 0.0F),
                                     static_cast<float>(hottest_w_m2_sr));
  }
  const auto radiance_at = [low = static_cast<double>(low_w_m2_sr_),
                            nodes_per_w_m2_sr = static_cast<double>(nodes_per_w_m2_sr_)](double position) {
    return low + position / nodes_per_w_m2_sr;
  };
  nodes_k_.resize(kSteps + 2);
  std::vector<double> middles_k(kSteps);
  parallel_for(kSteps, kRadianceNodesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      nodes_k_[node] = static_cast<float>(inverse_(radiance_at(static_cast<double>(node))));
      middles_k[node] = inverse_(radiance_at(static_cast<double>(node) + 0.5));
    }
  });
  nodes_k_[kSteps] = static_cast<float>(inverse_(radiance_at(kSteps)));
  nodes_k_[kSteps + 1] = nodes_k_[kSteps];  // position == last_position_ reads one node on
  for (std::size_t step = 0; step < kSteps; ++step) {
    // Between two nodes the error of a straight line through a smooth curve is largest at the middle.
    const auto line_k = static_cast<double>(between_nodes(static_cast<float>(step) + 0.5F));
    worst_error_k_ = std::max(worst_error_k_, std::abs(line_k - middles_k[step]));
  }
}

float TemperatureTable::between_nodes(float position) const noexcept {
  const auto node = static_cast<std::size_t>(position);
  const float share = position - static_cast<float>(node);
  return nodes_k_[node] + share * (nodes_k_[node + 1] - nodes_k_[node]);
}

void TemperatureTable::temperatures(std::span<const float> radiance_w_m2_sr,
                                    std::span<float> temperature_k) const {
  assert(radiance_w_m2_sr.size() == temperature_k.size());
  const Nodes nodes = {.low_w_m2_sr = low_w_m2_sr_, .nodes_per_w_m2_sr = nodes_per_w_m2_sr_};
  std::array<float, kRadiancesABlock> radiances{};  // a copy: input and output may be the same memory
  std::array<std::int32_t, kRadiancesABlock> node{};
  std::array<float, kRadiancesABlock> share{};
  for (std::size_t first = 0; first < radiance_w_m2_sr.size(); first += kRadiancesABlock) {
    const std::size_t count = std::min(kRadiancesABlock, radiance_w_m2_sr.size() - first);
    std::copy_n(&radiance_w_m2_sr[first], count, radiances.begin());
    const bool inside = find_nodes(nodes, radiances.data(), count, node.data(), share.data());
    for (std::size_t i = 0; i < count; ++i) {
      const float* below = &nodes_k_[static_cast<std::size_t>(node[i])];
      temperature_k[first + i] = below[0] + share[i] * (below[1] - below[0]);
    }
    if (inside) continue;
    for (std::size_t i = 0; i < count; ++i) {
      const float position = (radiances[i] - low_w_m2_sr_) * nodes_per_w_m2_sr_;
      if (position >= 0 && position <= last_position_) continue;
      if (hot_ && hot_->holds(radiances[i])) {
        temperature_k[first + i] = hot_->temperature_k(radiances[i], inverse_);
        continue;
      }
      temperature_k[first + i] = static_cast<float>(inverse_(static_cast<double>(radiances[i])));
    }
  }
}

}  // namespace thermal
