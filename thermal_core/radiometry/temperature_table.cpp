#include "radiometry/temperature_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <utility>

#include "base/clones.h"
#include "base/parallel.h"

namespace thermal {
namespace {

constexpr int kSteps = 8192;
constexpr std::size_t kRadiancesABlock = 256;
constexpr std::size_t kRadianceNodesAChunk = 128;

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
  parallel_for(kSteps, kRadianceNodesAChunk, [&](std::size_t begin, std::size_t end) {
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
