#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermal {

/// Heat that something gets [W m^-2], and how that changes with its temperature, or nearly so.
struct SurfaceFlux {
  double flux_w_m2 = 0;
  double slope_w_m2_k = 0;  ///< negative
};

/// Temperature at which a flux that falls with temperature is 0. A step by the slope from `guess_k`, then by the secant,
/// until one is below 1e-6 K; bisection where steps leave what is known, or after 20 of them. Within 100 K to 2000 K; NaN
/// for NaN.
/// @param flux_at  SurfaceFlux(double temperature_k); its slope may leave small parts out
template <typename FluxAt>
[[nodiscard]] double balanced_temperature_k(const FluxAt& flux_at, double guess_k) noexcept {
  constexpr double kSettledK = 1e-6;
  constexpr int kMostSteps = 20;
  double low_k = 100;
  double high_k = 2000;
  double at_k = std::clamp(guess_k, low_k, high_k);
  double last_k = at_k;
  double last_flux = std::numeric_limits<double>::quiet_NaN();
  for (int step = 0;; ++step) {
    const SurfaceFlux flux = flux_at(at_k);
    if (std::isnan(flux.flux_w_m2)) return flux.flux_w_m2;
    (flux.flux_w_m2 > 0 ? low_k : high_k) = at_k;
    const double secant = (flux.flux_w_m2 - last_flux) / (at_k - last_k);
    const double next_k = at_k - flux.flux_w_m2 / (secant < 0 ? secant : flux.slope_w_m2_k);
    const bool inside = next_k >= low_k && next_k <= high_k;
    if (inside && std::abs(next_k - at_k) < kSettledK) return next_k;
    if (high_k - low_k < kSettledK) return at_k;
    last_k = at_k;
    last_flux = flux.flux_w_m2;
    at_k = inside && step < kMostSteps ? next_k : 0.5 * (low_k + high_k);
  }
}

}  // namespace thermal
