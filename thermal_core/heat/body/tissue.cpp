#include "heat/body/tissue.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "base/error.h"
#include "base/ranges.h"

namespace thermal {
namespace {

constexpr double kMetWM2 = 58.15;

}  // namespace

double DrawnRange::at(double uniform) const noexcept {
  return std::lerp(low, high, std::clamp(uniform, 0.0, 1.0));
}

void DrawnRange::validate(const std::string& where, const char* unit, double lowest, double highest) const {
  require_range(where + "[0]", low, unit, lowest, highest);
  require_range(where + "[1]", high, unit, low, highest);
}

double metabolic_rate_w_m2(Activity activity) noexcept {
  return (activity == Activity::walking ? 2.6 : 1.2) * kMetWM2;
}

double relative_wind_m_s(double wind_m_s, double metabolic_w_m2) noexcept {
  return wind_m_s + 0.3 * std::max(0.0, metabolic_w_m2 / kMetWM2 - 1);
}

void Tissue::validate(const std::string& where) const {
  require_range(where + ".core_k", core_k, "K", 270, 320);
  require_range(where + ".warm_tissue_m2_k_w", warm_m2_k_w, "m^2 K/W", 0, 10);
  require_range(where + ".cold_tissue_m2_k_w", cold_m2_k_w, "m^2 K/W", warm_m2_k_w, 10);
}

double Tissue::resistance_m2_k_w(double air_k, Activity activity) const noexcept {
  constexpr double kColdAirK = 283;
  constexpr double kWarmAirK = 303;
  const double felt_k = air_k + (activity == Activity::walking ? 10 : 0);
  const double open = std::clamp((felt_k - kColdAirK) / (kWarmAirK - kColdAirK), 0.0, 1.0);
  return std::lerp(cold_m2_k_w, warm_m2_k_w, open);
}

}  // namespace thermal
