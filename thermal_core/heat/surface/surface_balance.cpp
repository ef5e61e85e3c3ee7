#include "heat/surface/surface_balance.h"

#include <algorithm>
#include <cmath>

#include "heat/surface/exchange.h"
#include "heat/weather/humid_air.h"

namespace thermal {
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

}  // namespace thermal
