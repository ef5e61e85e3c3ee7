#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "heat/surface/material_heat.h"
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

/// Orientation and exposure of a piece of a surface.
struct Site {
  EastNorthUp normal = {0, 0, 1};  ///< of unit length
  double sky_view = 1;             ///< share of the sky that its slope leaves and nothing hides, 0 to 1
  double sunlit = 1;               ///< share of the sun's beam that reaches it, 0 to 1
};

/// Radiation that arrives at a surface [W m^-2].
struct Incoming {
  double sun_w_m2 = 0;
  double longwave_w_m2 = 0;
};

/// Radiation that arrives at a site. Obstacles before the sky have the temperature of the air; the share of the view
/// below the horizon is ground at `ground_k`. Both reflect a fifth of their sunlight (estimate).
[[nodiscard]] Incoming incoming_at(const Forcing& forcing, const Site& site, double ground_k) noexcept;

/// Heat that goes into a body below its surface at the end of a step: slope_w_m2_k * surface_k - offset_w_m2.
struct HeatUptake {
  double slope_w_m2_k = 0;
  double offset_w_m2 = 0;
};

/// The balance of sunlight, longwave radiation, heat and vapour at a surface.
class SurfaceBalance {
 public:
  explicit SurfaceBalance(const SurfaceProperties& surface) noexcept;

  /// Net heat flux from above; its derivative neglects the change of the exchange with air.
  [[nodiscard]] SurfaceFlux flux(const Forcing& forcing, const Incoming& incoming,
                                 double surface_k) const noexcept;

  /// Temperature at which the flux from above equals the uptake: see balanced_temperature_k().
  [[nodiscard]] double balanced_k(const Forcing& forcing, const Incoming& incoming, const HeatUptake& uptake,
                                  double guess_k) const noexcept;

 private:
  [[nodiscard]] double exchange(const Forcing& forcing, double surface_k) const noexcept;

  SurfaceProperties surface_;
  GroundExchange ground_exchange_;
};

/// Share of even radiation from all of the sky that passes leaves of all directions: 2 E3(LAI / 2), the mean of
/// exp(-LAI / (2 sin h)) over the sky. Less than passes straight down, exp(-LAI / 2).
/// @param leaf_area_index  area of leaves above an area of ground, 0 to 100
[[nodiscard]] double diffuse_through_leaves(double leaf_area_index) noexcept;

/// How leaves stand: as a cover of the ground, or as single plants, through which the air of the open ground blows.
enum class Stand { cover, alone };

/// The balance of a layer of leaves above ground, per area of ground.
///
/// Leaves up to 2 m high that cover the ground exchange heat through the air above them as rough ground does, so they
/// get cold in calm nights; those of trees and of plants that stand alone are in the open wind. The wind among leaves is
/// half of that above (estimate).
class LeafLayer {
 public:
  explicit LeafLayer(const CanopyProperties& canopy, Stand stand = Stand::cover) noexcept;

  /// The weather among the leaves of a plant that stands alone on open ground: the air half-way up the plant.
  [[nodiscard]] Forcing among(const Forcing& forcing, double open_ground_k) const noexcept;

  /// Net heat flux into the leaves, and its derivative by their temperature.
  [[nodiscard]] SurfaceFlux flux(const Forcing& forcing, const Incoming& above, double ground_k,
                                 double leaves_k) const noexcept;

  /// Radiation that arrives at the ground below.
  [[nodiscard]] Incoming below(const Incoming& above, double leaves_k) const noexcept;

 private:
  CanopyProperties canopy_;
  Stand stand_;
  double shade_;   ///< share of sunlight that leaves take or reflect
  double screen_;  ///< share of longwave radiation that leaves exchange
  GroundExchange exchange_;
};

}  // namespace thermal
