#include "heat/surface/exchange.h"

#include <algorithm>
#include <cmath>

#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

constexpr double kHeightM = 2;  // of the forcing's air and wind
constexpr double kLeastWindMS = 0.3;

}  // namespace

double heat_of_air_j_m3_k(const Forcing& forcing) noexcept {
  return kHeatOfAirJKgK * air_density_kg_m3(forcing.pressure_hpa, forcing.air_k);
}

GroundExchange::GroundExchange(double roughness_m) noexcept
    : wind_log_(std::log(kHeightM / roughness_m)),
      heat_log_(std::log(10 * kHeightM / roughness_m)),
      neutral_(0.4 * 0.4 / (wind_log_ * heat_log_)),
      root_ratio_(std::sqrt(kHeightM / roughness_m)) {}

double GroundExchange::operator()(const Forcing& forcing, double surface_k) const noexcept {
  constexpr double kCalmWM2K = 1.5;
  constexpr double kGravity = 9.81;
  const double wind = std::max(forcing.wind_m_s, kLeastWindMS);
  const double lapse = (forcing.air_k - surface_k) / (0.5 * (forcing.air_k + surface_k));
  const double richardson = std::clamp(kGravity * kHeightM * lapse / (wind * wind), -5.0, 2.0);
  const double stable =
      1 / (1 + 15 * std::max(richardson, 0.0) * std::sqrt(1 + 5 * std::max(richardson, 0.0)));
  const double rising = std::max(-richardson, 0.0);
  const double unstable = 1 + 15 * rising / (1 + 75 * neutral_ * root_ratio_ * std::sqrt(rising));
  return heat_of_air_j_m3_k(forcing) * neutral_ * wind * (richardson > 0 ? stable : unstable) + kCalmWM2K;
}

double GroundExchange::air_k(const Forcing& forcing, double surface_k, double height_m) const noexcept {
  if (height_m >= kHeightM) return forcing.air_k;
  const double in_neutral_air =
      heat_of_air_j_m3_k(forcing) * neutral_ * std::max(forcing.wind_m_s, kLeastWindMS);
  const double hindered = std::max(1.0, in_neutral_air / (*this)(forcing, surface_k));
  // 5 z / L at 2 m: (wind_log + bend) (heat_log + bend) = hindered wind_log heat_log.
  const double half = (wind_log_ + heat_log_) / 2;
  const double bend = std::sqrt(half * half + wind_log_ * heat_log_ * (hindered - 1)) - half;
  const double share =
      (std::log(kHeightM / height_m) + bend * (1 - height_m / kHeightM)) / (heat_log_ + bend);
  return std::lerp(forcing.air_k, surface_k, std::clamp(share, 0.0, 1.0));
}

double body_exchange(double wind_m_s) noexcept { return 2.8 + 3.0 * wind_m_s; }

double leaf_resistance_s_m(double leaf_width_m, double wind_m_s) noexcept {
  return 50 * std::sqrt(leaf_width_m / std::max(wind_m_s, 0.15));
}

}  // namespace thermal
