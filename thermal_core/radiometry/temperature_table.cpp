#include "radiometry/temperature_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace thermal {
namespace {

constexpr int kSteps = 8192;

}  // namespace

TemperatureTable::TemperatureTable(Inverse inverse, double low_w_m2_sr, double high_w_m2_sr)
    : inverse_(std::move(inverse)),
      low_w_m2_sr_(static_cast<float>(low_w_m2_sr)),
      nodes_per_w_m2_sr_(static_cast<float>(kSteps / (high_w_m2_sr - low_w_m2_sr))),
      last_position_(static_cast<float>(kSteps)) {
  assert(0 < low_w_m2_sr && low_w_m2_sr < high_w_m2_sr);
  const auto radiance_at = [low = static_cast<double>(low_w_m2_sr_),
                            nodes_per_w_m2_sr = static_cast<double>(nodes_per_w_m2_sr_)](double position) {
    return low + position / nodes_per_w_m2_sr;
  };
  nodes_k_.reserve(kSteps + 2);
  for (int node = 0; node <= kSteps; ++node) {
    nodes_k_.push_back(static_cast<float>(inverse_(radiance_at(node))));
  }
  nodes_k_.push_back(nodes_k_.back());  // position == last_position_ reads one node on
  for (int step = 0; step < kSteps; ++step) {
    // Between two nodes the error of a straight line through a smooth curve is largest at the middle.
    const double exact_k = inverse_(radiance_at(step + 0.5));
    const auto line_k = static_cast<double>(between_nodes(static_cast<float>(step) + 0.5F));
    worst_error_k_ = std::max(worst_error_k_, std::abs(line_k - exact_k));
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
  for (std::size_t i = 0; i < radiance_w_m2_sr.size(); ++i) {
    const float position = (radiance_w_m2_sr[i] - low_w_m2_sr_) * nodes_per_w_m2_sr_;
    const bool inside = position >= 0 && position <= last_position_;
    temperature_k[i] = inside ? between_nodes(position)
                              : static_cast<float>(inverse_(static_cast<double>(radiance_w_m2_sr[i])));
  }
}

}  // namespace thermal
