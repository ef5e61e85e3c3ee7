#include "heat/surface/leaf_layer.h"

#include <algorithm>
#include <cmath>

#include "heat/weather/humid_air.h"

namespace thermal {

double diffuse_through_leaves(double leaf_area_index) noexcept {
  const double depth = leaf_area_index / 2;
  if (depth <= 0) return 1;
  const double passed = std::exp(-depth);
  const double e2 = passed + depth * std::expint(-depth);  // E1(x) = -Ei(-x)
  return std::max(0.0, passed - depth * e2);
}

LeafLayer::LeafLayer(const CanopyProperties& canopy, Stand stand) noexcept
    : canopy_(canopy),
      stand_(stand),
      shade_(canopy.cover()),
      screen_(1 - diffuse_through_leaves(canopy.leaf_area_index)),
      exchange_(std::min(0.13 * canopy.height_m + 0.01, 0.5)) {}

Forcing LeafLayer::among(const Forcing& forcing, double open_ground_k) const noexcept {
  if (stand_ == Stand::cover) return forcing;
  // Grass with few obstacles (Wieringa, J. Wind Eng. Ind. Aerodyn. 41, 357, 1992).
  static const GroundExchange kOpenGround(0.03);
  Forcing among = forcing;
  among.air_k = kOpenGround.air_k(forcing, open_ground_k, canopy_.height_m / 2);
  among.vapour_hpa = std::min(forcing.vapour_hpa, saturation_hpa(among.air_k));
  return among;
}

SurfaceFlux LeafLayer::flux(const Forcing& forcing, const Incoming& above, double ground_k,
                            double leaves_k) const noexcept {
  constexpr double kLowM = 2;          // the height of the forcing's air
  constexpr double kWindAmong = 0.5;   // of the wind above
  constexpr double kAloneToAirS = 12;  // resistance times wind, of plants that stand alone (estimate)
  constexpr double kLightWM2 = 200;    // in which stomata are wide open (estimate, after Jarvis 1976)
  const double heat_of_air = heat_of_air_j_m3_k(forcing);
  const double wind = std::max(forcing.wind_m_s, 0.3);
  const double own = leaf_resistance_s_m(canopy_.leaf_width_m, kWindAmong * wind) / canopy_.leaf_area_index;
  const bool low = stand_ == Stand::cover && canopy_.height_m <= kLowM;
  const double to_open_air = low ? heat_of_air / exchange_(forcing, leaves_k) : kAloneToAirS / wind;
  const double to_air = heat_of_air / (own + to_open_air);
  const double saturated_hpa = saturation_hpa(leaves_k);
  const bool dew = saturated_hpa < forcing.vapour_hpa;
  const double conductance = canopy_.leaf_conductance_m_s * std::min(1.0, forcing.global_w_m2 / kLightWM2);
  double per_hpa = 0;
  if (dew || conductance > 0) {
    const double stomata = dew ? 0 : 1 / (conductance * canopy_.leaf_area_index);
    per_hpa = heat_of_air * kVaporisationJKg / kHeatOfAirJKgK * specific_humidity(1, forcing.pressure_hpa) /
              (own + to_open_air + stomata);
  }
  const double emitted = 2 * screen_ * canopy_.emissivity * kStefanBoltzmann * leaves_k * leaves_k * leaves_k;
  const double arriving = shade_ * (1 - canopy_.albedo) * above.sun_w_m2 +
                          screen_ * canopy_.emissivity * (above.longwave_w_m2 + blackbody_w_m2(ground_k));
  return {.flux_w_m2 = arriving - emitted * leaves_k - to_air * (leaves_k - forcing.air_k) -
                       per_hpa * (saturated_hpa - forcing.vapour_hpa),
          .slope_w_m2_k = -4 * emitted - to_air - per_hpa * saturation_slope_hpa_k(leaves_k, saturated_hpa)};
}

Incoming LeafLayer::below(const Incoming& above, double leaves_k) const noexcept {
  return {.sun_w_m2 = (1 - shade_) * above.sun_w_m2,
          .longwave_w_m2 = (1 - screen_) * above.longwave_w_m2 + screen_ * blackbody_w_m2(leaves_k)};
}

}  // namespace thermal
