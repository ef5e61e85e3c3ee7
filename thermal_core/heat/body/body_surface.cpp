#include "heat/body/body_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

constexpr double kFreeConvection = 2.38;  // ISO 7730

/// Mean over all azimuths of max(0, cosine) between a surface of a slope and the sun.
double mean_beam_cosine(double normal_z, double sun_z) {
  const double along = normal_z * sun_z;
  const double across = std::sqrt(std::max(0.0, (1 - normal_z * normal_z) * (1 - sun_z * sun_z)));
  if (along >= across) return along;
  if (along <= -across) return 0;
  const double half_turn = std::acos(-along / across);
  return (along * half_turn + across * std::sin(half_turn)) / std::numbers::pi;
}

double wind_convection(const BodySurface& surface, const Forcing& forcing) {
  if (surface.diameter_m <= 0) return 12.1 * std::sqrt(forcing.wind_m_s);
  // Air at 20 deg C and 1013.25 hPa, and how its viscosity changes from there.
  constexpr double kConductivityWMK = 0.0257;
  constexpr double kViscosityM2S = 1.51e-5;
  const double viscosity =
      kViscosityM2S * std::pow(forcing.air_k / 293.15, 1.75) * 1013.25 / forcing.pressure_hpa;
  const double reynolds = forcing.wind_m_s * surface.diameter_m / viscosity;
  return 0.24 * std::pow(reynolds, 0.6) * kConductivityWMK / surface.diameter_m;
}

/// Flux of heat with vapour [W m^-2], and its slope. Vapour rises from a wet surface of the air's temperature too, so
/// free convection is taken as at 1 K at least; that keeps the flux rising with temperature.
SurfaceFlux evaporation(const BodySurface& surface, const Forcing& forcing, double from_wind,
                        double surface_k) {
  const double saturated = specific_humidity(saturation_hpa(surface_k), forcing.pressure_hpa);
  const double humidity = specific_humidity(forcing.vapour_hpa, forcing.pressure_hpa);
  const double wet = saturated < humidity ? 1 : surface.wet;
  const double difference = surface_k - forcing.air_k;
  const double free = kFreeConvection * std::pow(difference * difference + 1, 0.125);
  const double per_humidity = wet * kVaporisationJKg / kHeatOfAirJKgK * std::max(free, from_wind);
  const double slope =
      specific_humidity(saturation_slope_hpa_k(surface_k, saturation_hpa(surface_k)), forcing.pressure_hpa);
  return {.flux_w_m2 = per_humidity * (saturated - humidity), .slope_w_m2_k = per_humidity * slope};
}

SurfaceFlux flux_in_wind(const BodySurface& surface, const HeatWithin& within, const Forcing& forcing,
                         const Incoming& incoming, double from_wind, double surface_k) {
  const double difference = surface_k - forcing.air_k;
  const double free = kFreeConvection * std::pow(std::abs(difference), 0.25);
  const double to_air = std::max(free, from_wind);
  const double to_air_slope = free > from_wind ? 1.25 * free : from_wind;
  const double radiating = surface.emissivity * surface.open_view;
  const double emitted = kStefanBoltzmann * surface_k * surface_k * surface_k;
  const SurfaceFlux vapour = evaporation(surface, forcing, from_wind, surface_k);
  const double outside = (1 - surface.albedo) * incoming.sun_w_m2 +
                         radiating * (incoming.longwave_w_m2 - emitted * surface_k) - to_air * difference -
                         vapour.flux_w_m2;
  return {.flux_w_m2 = within.w_m2_k * (within.inside_k - surface_k) + within.source_w_m2 +
                       surface.area_factor * outside,
          .slope_w_m2_k = -within.w_m2_k - surface.area_factor * (4 * radiating * emitted + to_air_slope +
                                                                  vapour.slope_w_m2_k)};
}

}  // namespace

void BodySurface::validate(const std::string& where) const {
  require_range(where + ".albedo", albedo, "", 0, 1);
  require_share_above_0(where + ".broadband_emissivity", emissivity);
  require_share_above_0(where + ".open_view", open_view);
  require_range(where + ".area_factor", area_factor, "", 1, 3);
  if (diameter_m != 0) require_range(where + ".diameter_m", diameter_m, "m", 0.002, 5);
  require_range(where + ".wet", wet, "", 0, 1);
}

Incoming incoming_on(const Surroundings& around, const EastNorthUp& normal) noexcept {
  return incoming_at(around.forcing, {.normal = normal, .sky_view = around.sky_view, .sunlit = around.sunlit},
                     around.ground_k);
}

Incoming incoming_on_slope(const Surroundings& around, double normal_z) noexcept {
  const double up = std::clamp(normal_z, -1.0, 1.0);
  Surroundings without_beam = around;
  without_beam.forcing.beam_w_m2 = 0;
  Incoming incoming = incoming_on(without_beam, {std::sqrt(1 - up * up), 0, up});
  incoming.sun_w_m2 += around.forcing.beam_w_m2 * around.sunlit * mean_beam_cosine(up, around.forcing.sun[2]);
  return incoming;
}

double body_convection(const BodySurface& surface, const Forcing& forcing, double surface_k) noexcept {
  return std::max(kFreeConvection * std::pow(std::abs(surface_k - forcing.air_k), 0.25),
                  wind_convection(surface, forcing));
}

SurfaceFlux body_flux(const BodySurface& surface, const HeatWithin& within, const Forcing& forcing,
                      const Incoming& incoming, double surface_k) noexcept {
  return flux_in_wind(surface, within, forcing, incoming, wind_convection(surface, forcing), surface_k);
}

double body_surface_k(const BodySurface& surface, const HeatWithin& within, const Forcing& forcing,
                      const Incoming& incoming) noexcept {
  if (std::isinf(within.w_m2_k)) return within.inside_k;
  const double from_wind = wind_convection(surface, forcing);
  return balanced_temperature_k(
      [&](double surface_k) {
        return flux_in_wind(surface, within, forcing, incoming, from_wind, surface_k);
      },
      forcing.air_k);
}

}  // namespace thermal
