#pragma once

#include "heat/weather/forcing.h"

namespace thermal {

/// Heat transfer coefficient of level ground to air [W m^-2 K^-1]: logarithmic profile up to 2 m with the stability
/// functions of Louis, Tiedtke and Geleyn (1982), roughness for heat a tenth of that for wind, and at least 1.5 W m^-2
/// K^-1 without wind (estimate, free convection of calm air). Wind below 0.3 m/s counts as 0.3; bulk Richardson numbers
/// are clamped to -5 and 2.
class GroundExchange {
 public:
  /// @param roughness_m  of the ground, 1e-5 to 0.5
  explicit GroundExchange(double roughness_m) noexcept;

  [[nodiscard]] double operator()(const Forcing& forcing, double surface_k) const noexcept;

  /// Temperature of the air up to 2 m above such ground [K]: the log-linear profile of stable air (Businger and others
  /// 1971), with the stability that gives the heat exchange above; by day that of neutral air.
  /// @param height_m  above the ground, above 0; from 2 m on, the forcing's temperature
  [[nodiscard]] double air_k(const Forcing& forcing, double surface_k, double height_m) const noexcept;

 private:
  double wind_log_;    ///< ln(2 m / roughness)
  double heat_log_;    ///< the same for heat
  double neutral_;     ///< share of the wind that exchanges heat in neutral air
  double root_ratio_;  ///< sqrt(2 m / roughness)
};

/// Heat transfer coefficient of a plate or trunk one or two metres across [W m^-2 K^-1]: 2.8 + 3.0 u (Watmuff, Charters
/// and Proctor, COMPLES 1977; measured on solar collectors, 0 to 7 m/s).
[[nodiscard]] double body_exchange(double wind_m_s) noexcept;

/// Boundary layer of one leaf, in resistance per area of its two sides [s/m]: 100 sqrt(width / wind) / 2 (Jones, Plants
/// and Microclimate, 1992). Wind below 0.15 m/s counts as that.
[[nodiscard]] double leaf_resistance_s_m(double leaf_width_m, double wind_m_s) noexcept;

/// Heat capacity of a cubic metre of the forcing's air [J m^-3 K^-1].
[[nodiscard]] double heat_of_air_j_m3_k(const Forcing& forcing) noexcept;

}  // namespace thermal
