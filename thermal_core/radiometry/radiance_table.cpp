#include "radiometry/radiance_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr std::size_t kTemperaturesABlock = 256;
constexpr std::size_t kNodesAChunk = 64;

}  // namespace

RadianceTable::RadianceTable(BandRadiance band) : band_(std::move(band)) {
  std::vector<double> at_nodes(kSteps + 1);
  std::vector<BandValue> at_middles(kSteps);
  parallel_for(kSteps, kNodesAChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      at_nodes[node] = band_.radiance(node_k(static_cast<double>(node)));
      at_middles[node] = band_.evaluate(node_k(static_cast<double>(node) + 0.5));
    }
  });
  at_nodes[kSteps] = band_.radiance(node_k(kSteps));
  nodes_.reserve(kSteps);
  for (std::size_t node = 0; node < kSteps; ++node)
    nodes_.push_back(
        {static_cast<float>(at_nodes[node]), static_cast<float>(at_nodes[node + 1] - at_nodes[node])});
  measure(at_nodes, at_middles);
}

void RadianceTable::measure(const std::vector<double>& at_nodes, const std::vector<BandValue>& at_middles) {
  // Radiance is convex, so a line between two nodes is furthest from it at the middle. Node and result are floats,
  // half an eps off each at most, and so are, of itself, the step and what is taken of it.
  constexpr double kRounding = static_cast<double>(std::numeric_limits<float>::epsilon()) / 2;
  for (std::size_t node = 0; node < kSteps; ++node) {
    const double here = at_nodes[node];
    const double next = at_nodes[node + 1];
    const BandValue& middle = at_middles[node];
    const double departure = (here + next) / 2 - middle.radiance_w_m2_sr;
    const double error = departure + 2 * kRounding * (next + (next - here));
    worst_error_k_ = std::max(worst_error_k_, error / middle.derivative_w_m2_sr_k);
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

}  // namespace thermal
