#include "heat/body/warm_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/ranges.h"

namespace thermal {

void WarmedGround::validate(const std::string& where) const {
  require_range(where + ".inertia_j_m2_k_s", inertia_j_m2_k_s, "J/(m^2 K s^0.5)", 50, 20000);
  require_range(where + ".to_air_w_m2_k", to_air_w_m2_k, "W/(m^2 K)", 0, 500);
}

double thermal_inertia(const GroundProperties& ground) noexcept {
  return std::sqrt(ground.conductivity_w_m_k * ground.heat_capacity_j_m3_k);
}

double scaled_erfc(double x) noexcept {
  constexpr double kFar = 5;
  if (x < kFar) return std::exp(x * x) * std::erfc(x);
  if (std::isinf(x)) return 0;
  // Continued fraction of erfc, from its end.
  double fraction = x;
  for (int k = 40; k >= 1; --k) fraction = x + 0.5 * k / fraction;
  return 1 / (std::sqrt(std::numbers::pi) * fraction);
}

void Lying::validate(const std::string& where) const {
  require_range(where + ".body_k", body_k, "K", 200, 330);
  require_range(where + ".contact_m2_k_w", contact_m2_k_w, "m^2 K/W", 0.001, 10);
  require_range(where + ".time_s", time_s, "s", 0, 1e7);
}

double bed_excess_k(const Lying& lying, const WarmedGround& ground, double ground_k) noexcept {
  const double reach = std::sqrt(lying.time_s) / (lying.contact_m2_k_w * ground.inertia_j_m2_k_s);
  return (lying.body_k - ground_k) * (1 - scaled_erfc(reach));
}

double bed_share_left(double lain_s, double since_s, const WarmedGround& ground) noexcept {
  if (!(lain_s > 0)) return 0;
  const double kept = 2 / std::numbers::pi * std::asin(std::sqrt(lain_s / (lain_s + std::max(0.0, since_s))));
  return kept *
         scaled_erfc(ground.to_air_w_m2_k * std::sqrt(std::max(0.0, since_s)) / ground.inertia_j_m2_k_s);
}

}  // namespace thermal
