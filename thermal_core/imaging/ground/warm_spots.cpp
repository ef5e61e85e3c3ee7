#include "imaging/ground/warm_spots.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

float excess_in(const WarmSpot& spot, double east_m, double north_m) noexcept {
  const double span_m = spot.reach * std::max(spot.half_length_m, spot.half_width_m);
  if (!(std::abs(east_m) < span_m && std::abs(north_m) < span_m)) return 0;  // NaN too
  const double along_m = east_m * std::cos(spot.heading_rad) + north_m * std::sin(spot.heading_rad);
  const double across_m = north_m * std::cos(spot.heading_rad) - east_m * std::sin(spot.heading_rad);
  const double out = std::hypot(along_m / spot.half_length_m, across_m / spot.half_width_m);
  if (!(out < spot.reach)) return 0;
  const double position = out / spot.reach * static_cast<double>(spot.excess_k.size() - 1);
  const auto node = std::min(static_cast<std::size_t>(position), spot.excess_k.size() - 2);
  const auto share = static_cast<float>(position - static_cast<double>(node));
  return spot.excess_k[node] + share * (spot.excess_k[node + 1] - spot.excess_k[node]);
}

}  // namespace

float WarmSpots::excess_k(float x_m, float y_m) const noexcept {
  float warmest_k = 0;
  for (const WarmSpot& spot : spots_) {
    const double east_m = static_cast<double>(x_m) - spot.x_m;
    const double north_m = static_cast<double>(y_m) - spot.y_m;
    warmest_k = std::max(warmest_k, excess_in(spot, east_m, north_m));
  }
  return warmest_k;
}

void WarmSpots::add(std::span<const std::uint16_t> surface, std::span<const std::int32_t> is_ground,
                    std::span<const float> x_m, std::span<const float> y_m,
                    std::span<float> temperature_k) const noexcept {
  if (spots_.empty()) return;
  for (std::size_t i = 0; i < temperature_k.size(); ++i) {
    if (is_ground[surface[i]] != 0) temperature_k[i] += excess_k(x_m[i], y_m[i]);
  }
}

}  // namespace thermal
