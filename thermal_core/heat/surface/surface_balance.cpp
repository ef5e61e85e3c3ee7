#include "heat/surface/surface_balance.h"

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

namespace {

constexpr double kReflected = 0.2;  // of sunlight, by what stands around

}  // namespace

Incoming incoming_at(const Forcing& forcing, const Site& site, double ground_k) noexcept {
  const EastNorthUp& n = site.normal;
  const double facing_up = 0.5 * (1 + n[2]);
  const double sky = site.sky_view * facing_up;
  const double hidden = facing_up - sky;
  const double cosine = std::max(0.0, n[0] * forcing.sun[0] + n[1] * forcing.sun[1] + n[2] * forcing.sun[2]);
  const double around_w_m2 =
      hidden * blackbody_w_m2(forcing.air_k) + (1 - facing_up) * blackbody_w_m2(ground_k);
  return {.sun_w_m2 = forcing.beam_w_m2 * cosine * site.sunlit + forcing.diffuse_w_m2 * sky +
                      kReflected * (1 - sky) * forcing.global_w_m2 * site.sunlit,
          .longwave_w_m2 = sky * forcing.sky_w_m2 + around_w_m2};
}

SurfaceBalance::SurfaceBalance(const SurfaceProperties& surface) noexcept
    : surface_(surface), ground_exchange_(std::max(surface.roughness_m, 1e-5)) {}

double SurfaceBalance::exchange(const Forcing& forcing, double surface_k) const noexcept {
  return surface_.roughness_m > 0 ? ground_exchange_(forcing, surface_k) : body_exchange(forcing.wind_m_s);
}

SurfaceFlux SurfaceBalance::flux(const Forcing& forcing, const Incoming& incoming,
                                 double surface_k) const noexcept {
  const double to_air = exchange(forcing, surface_k);
  const double saturated_hpa = saturation_hpa(surface_k);
  const bool dew = saturated_hpa < forcing.vapour_hpa;  // falls on anything
  // Vapour and heat leave through the same air.
  const double per_hpa = (dew ? 1 : surface_.evaporation) * to_air * kVaporisationJKg / kHeatOfAirJKgK *
                         specific_humidity(1, forcing.pressure_hpa);
  const double emitted = surface_.emissivity * kStefanBoltzmann * surface_k * surface_k * surface_k;
  return {.flux_w_m2 = (1 - surface_.albedo) * incoming.sun_w_m2 +
                       surface_.emissivity * incoming.longwave_w_m2 - emitted * surface_k -
                       to_air * (surface_k - forcing.air_k) - per_hpa * (saturated_hpa - forcing.vapour_hpa),
          .slope_w_m2_k = -4 * emitted - to_air - per_hpa * saturation_slope_hpa_k(surface_k, saturated_hpa)};
}

double SurfaceBalance::balanced_k(const Forcing& forcing, const Incoming& incoming, const HeatUptake& uptake,
                                  double guess_k) const noexcept {
  const auto left_over = [&](double surface_k) {
    const SurfaceFlux above = flux(forcing, incoming, surface_k);
    return SurfaceFlux{above.flux_w_m2 - uptake.slope_w_m2_k * surface_k + uptake.offset_w_m2,
                       above.slope_w_m2_k - uptake.slope_w_m2_k};
  };
  return balanced_temperature_k(left_over, guess_k);
}

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
