#include "heat/body/fire.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "heat/weather/humid_air.h"

namespace thermal {

void WarmedGround::validate(const std::string& where) const {
  require_range(where + ".inertia_j_m2_k_s", inertia_j_m2_k_s, "J/(m^2 K s^0.5)", 50, 20000);
  require_range(where + ".to_air_w_m2_k", to_air_w_m2_k, "W/(m^2 K)", 0, 500);
}

double thermal_inertia(const GroundProperties& ground) noexcept {
  return std::sqrt(ground.conductivity_w_m_k * ground.heat_capacity_j_m3_k);
}

double scaled_erfc(double x) noexcept {
  constexpr double kFar = 5;
  if (x < kFar) return std::exp(x * x) * std::erfc(x);
  if (std::isinf(x)) return 0;
  // Continued fraction of erfc, from its end.
  double fraction = x;
  for (int k = 40; k >= 1; --k) fraction = x + 0.5 * k / fraction;
  return 1 / (std::sqrt(std::numbers::pi) * fraction);
}

void Lying::validate(const std::string& where) const {
  require_range(where + ".body_k", body_k, "K", 200, 330);
  require_range(where + ".contact_m2_k_w", contact_m2_k_w, "m^2 K/W", 0.001, 10);
  require_range(where + ".time_s", time_s, "s", 0, 1e7);
}

double bed_excess_k(const Lying& lying, const WarmedGround& ground, double ground_k) noexcept {
  const double reach = std::sqrt(lying.time_s) / (lying.contact_m2_k_w * ground.inertia_j_m2_k_s);
  return (lying.body_k - ground_k) * (1 - scaled_erfc(reach));
}

double bed_share_left(double lain_s, double since_s, const WarmedGround& ground) noexcept {
  if (!(lain_s > 0)) return 0;
  const double kept = 2 / std::numbers::pi * std::asin(std::sqrt(lain_s / (lain_s + std::max(0.0, since_s))));
  return kept *
         scaled_erfc(ground.to_air_w_m2_k * std::sqrt(std::max(0.0, since_s)) / ground.inertia_j_m2_k_s);
}

namespace {

constexpr double kPi = std::numbers::pi;

double to_fourth(double x) { return x * x * x * x; }

/// Ground as a body: a wide low cylinder in the wind.
BodySurface as_body(const GroundProperties& ground) {
  return {.albedo = ground.surface.albedo, .emissivity = ground.surface.emissivity, .diameter_m = 1};
}

}  // namespace

void CampFire::validate(const std::string& where) const {
  require_range(where + ".diameter_m", diameter_m, "m", 0.1, 5);
  require_range(where + ".burn_rate_kg_m2_s", burn_rate_kg_m2_s, "kg/(m^2 s)", 0, 0.1);
  require_range(where + ".radiant_share", radiant_share, "", 0, 1);
  require_range(where + ".flame_k", flame_k, "K", 800, 1500);
  require_range(where + ".flame_absorption_m", flame_absorption_m, "1/m", 0, 10);
  require_range(where + ".ember_k", ember_k, "K", 600, 1400);
  require_range(where + ".ember_share", ember_share, "", 0, 1);
  require_range(where + ".ash_k", ash_k, "K", 300, 1000);
  require_share_above_0(where + ".emissivity", emissivity);
  require_range(where + ".burning_s", burning_s, "s", 0, 1e7);
}

double fire_power_w(const CampFire& fire) noexcept {
  constexpr double kHeatOfWoodJKg = 15e6;
  return fire.burn_rate_kg_m2_s * kHeatOfWoodJKg * kPi / 4 * fire.diameter_m * fire.diameter_m;
}

double flame_height_m(const CampFire& fire) noexcept {
  return std::max(0.0, 0.235 * std::pow(fire_power_w(fire) / 1000, 0.4) - 1.02 * fire.diameter_m);
}

double flame_emissivity(const CampFire& fire) noexcept {
  return -std::expm1(-fire.flame_absorption_m * fire.diameter_m);
}

double bed_mean_k(const CampFire& fire) noexcept {
  return std::sqrt(
      std::sqrt(fire.ember_share * to_fourth(fire.ember_k) + (1 - fire.ember_share) * to_fourth(fire.ash_k)));
}

double fire_irradiance_w_m2(const CampFire& fire, double distance_m) noexcept {
  const double height_m = std::max(0.1, 0.5 * flame_height_m(fire));
  const double away_m = std::max(distance_m, 0.5 * fire.diameter_m);
  const double square = away_m * away_m + height_m * height_m;
  return fire.radiant_share * fire_power_w(fire) / (4 * kPi * square) * height_m / std::sqrt(square);
}

double fireside_ground_k(const CampFire& fire, const Surroundings& around, const GroundProperties& ground,
                         double undisturbed_k, double distance_m) noexcept {
  const BodySurface surface = as_body(ground);
  const Incoming incoming = incoming_on_slope(around, 1);
  // Heat from below in equilibrium without the fire.
  const double from_below = -body_flux(surface, {}, around.forcing, incoming, undisturbed_k).flux_w_m2;
  const HeatWithin within = {
      .inside_k = undisturbed_k,
      .w_m2_k = thermal_inertia(ground) / std::sqrt(kPi * std::max(1.0, fire.burning_s)),
      .source_w_m2 = from_below + surface.emissivity * fire_irradiance_w_m2(fire, distance_m)};
  return body_surface_k(surface, within, around.forcing, incoming);
}

double ash_bed_k(const CampFire& fire, const Surroundings& around, const GroundProperties& ground,
                 double undisturbed_k, double since_s, double ember_s) noexcept {
  BodySurface surface = as_body(ground);
  surface.emissivity = fire.emissivity;
  const Incoming incoming = incoming_on_slope(around, 1);
  const double from_below = -body_flux(surface, {}, around.forcing, incoming, undisturbed_k).flux_w_m2;
  // Power of the embers when the flames go out: what keeps the bed at its temperature at that moment.
  const double full =
      -body_flux(surface, {}, around.forcing, incoming, bed_mean_k(fire)).flux_w_m2 - from_below;
  // Heat that the ground took up at bed_mean_k while the fire burnt, and returns.
  const double since = std::max(1.0, since_s);
  const double inertia = thermal_inertia(ground);
  const double back = inertia / std::sqrt(kPi) * (bed_mean_k(fire) - undisturbed_k) *
                      (1 / std::sqrt(since) - 1 / std::sqrt(since + fire.burning_s));
  const double embers = full * std::exp(-since_s / ember_s);
  const HeatWithin within = {.source_w_m2 = from_below + std::min(full, embers + std::max(0.0, back))};
  return body_surface_k(surface, within, around.forcing, incoming);
}

}  // namespace thermal
