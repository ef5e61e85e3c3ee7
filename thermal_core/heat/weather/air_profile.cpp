#include "heat/weather/air_profile.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

constexpr double kForcingHeightM = 2;

/// Integral of Webb's gradient over the height, from `low` to `high`, in units of 2 m.
double profile_between(double low, double high, double stability) noexcept {
  constexpr double kWebb = 5.2;
  const auto correction = [stability](double height) {
    const double over_length = height * stability;
    return over_length <= 1 ? over_length : 1 + std::log(over_length);
  };
  return std::log(high / low) + kWebb * (correction(high) - correction(low));
}

}  // namespace

StableAir::StableAir(const Forcing& forcing, double ground_k, double roughness_m) noexcept {
  constexpr double kCalmWindMS = 0.3;
  constexpr double kGravity = 9.81;
  constexpr int kHalvings = 60;
  const double difference_k = forcing.air_k - ground_k;
  if (!(difference_k > 0)) return;
  const double wind = std::max(forcing.wind_m_s, kCalmWindMS);
  const double richardson =
      kGravity * kForcingHeightM * difference_k / (0.5 * (forcing.air_k + ground_k) * wind * wind);
  const double of_wind = roughness_m / kForcingHeightM;
  const double of_heat = 0.1 * of_wind;
  double low = std::log(1e-9);
  double high = std::log(1e9);
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    const double stability = std::exp(middle);
    const double winds = profile_between(of_wind, 1, stability);
    const bool below = stability * profile_between(of_heat, 1, stability) < richardson * winds * winds;
    (below ? low : high) = middle;
  }
  stability_ = std::exp(0.5 * (low + high));
  scale_k_ = difference_k / profile_between(of_heat, 1, stability_);
}

double StableAir::warmer_k(double height_m) const noexcept {
  constexpr double kHighestM = 150;
  constexpr double kLapseKM = 0.0098;
  if (!(height_m > kForcingHeightM) || scale_k_ <= 0) return 0;
  const double height = std::min(height_m, kHighestM);
  const double warmer = scale_k_ * profile_between(1, height / kForcingHeightM, stability_);
  return std::max(0.0, warmer - kLapseKM * (height - kForcingHeightM));
}

}  // namespace thermal
