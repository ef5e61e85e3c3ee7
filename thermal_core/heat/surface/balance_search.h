#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermal {

/// Net heat flux into a surface [W m^-2], and its exact or approximate derivative by temperature.
struct SurfaceFlux {
  double flux_w_m2 = 0;
  double slope_w_m2_k = 0;  ///< negative
};

/// Root of a flux that falls with temperature [K]: a Newton step from `guess_k`, then the secant method until a step is
/// below 1e-6 K; bisection where a step leaves the bracket, or after 20 steps. Within 100 K to 2000 K; NaN for NaN.
/// @param flux_at  SurfaceFlux(double temperature_k); its derivative may neglect small parts
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
