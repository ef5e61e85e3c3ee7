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
constexpr std::size_t kKnotsAChunk = 16;

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
  parallel_for(knots.size(), kKnotsAChunk, [&](std::size_t begin, std::size_t end) {
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

}  // namespace thermal
