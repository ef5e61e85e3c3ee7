#pragma once

#include "heat/weather/forcing.h"

namespace thermal {

/// The air's profile above ground that is colder than it: Monin-Obukhov similarity with the gradient of Webb (QJRMS 96,
/// 67, 1970), 1 + 5.2 z / L up to z = L and 6.2 above it, the same for heat and wind. A steady profile has one Obukhov
/// length for any wind and any difference of temperature; it has no top of its own.
class StableAir {
 public:
  /// Wind below 0.3 m/s counts as 0.3, as in GroundExchange.
  /// @param ground_k  of the open plain around
  /// @param roughness_m  of it; 0.03: grass with few obstacles (Wieringa, J. Wind Eng. Ind. Aerodyn. 41, 357, 1992)
  StableAir(const Forcing& forcing, double ground_k, double roughness_m = 0.03) noexcept;

  /// z / L at the forcing's height, 2 m; 0 where ground is not colder than air.
  [[nodiscard]] double stability() const noexcept { return stability_; }

  /// How much warmer air is at a height above the ground than at 2 m [K], with the dry adiabatic lapse: at least 0.
  /// Below 2 m, and where the ground is not colder, 0; above 150 m as there, a deep nocturnal inversion's (estimate).
  [[nodiscard]] double warmer_k(double height_m) const noexcept;

 private:
  double stability_ = 0;
  double scale_k_ = 0;  ///< of temperature, over von Karman's constant
};

}  // namespace thermal
