#include "radiometry/radiance_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace thermal {
namespace {

constexpr std::size_t kBlock = 256;

}  // namespace

RadianceTable::RadianceTable(BandRadiance band) : band_(std::move(band)) {
  nodes_.reserve(kSteps);
  double here = band_.radiance(node_k(0));
  for (int node = 0; node < kSteps; ++node) {
    const double next = band_.radiance(node_k(node + 1));
    nodes_.push_back({static_cast<float>(here), static_cast<float>(next - here)});
    here = next;
  }
  measure();
}

void RadianceTable::measure() {
  // Between two nodes the error of a straight line through a smooth curve is largest at the middle; quarter
  // points show that rounding has not moved it.
  for (int quarter = 0; quarter < 4 * kSteps; ++quarter) {
    const double temperature_k = node_k(quarter / 4.0);
    const float out = radiance(static_cast<float>(temperature_k));
    const BandValue exact = band_.evaluate(temperature_k);
    const double error = std::abs(static_cast<double>(out) - exact.radiance_w_m2_sr);
    worst_error_k_ = std::max(worst_error_k_, error / exact.derivative_w_m2_sr_k);
    worst_relative_error_ = std::max(worst_relative_error_, error / exact.radiance_w_m2_sr);
  }
}

float RadianceTable::outside(float temperature_k) const noexcept {
  return static_cast<float>(band_.radiance(static_cast<double>(temperature_k)));
}

void RadianceTable::radiances(std::span<const float> temperature_k,
                              std::span<float> radiance_w_m2_sr) const noexcept {
  assert(temperature_k.size() == radiance_w_m2_sr.size());
  for (std::size_t begin = 0; begin < temperature_k.size(); begin += kBlock) {
    const auto in = temperature_k.subspan(begin, std::min(kBlock, temperature_k.size() - begin));
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
