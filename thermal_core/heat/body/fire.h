#pragma once

#include <string>

#include "heat/body/body_surface.h"
#include "heat/surface/material_heat.h"

namespace thermal {

/// Ground that something warm touches, or is near to.
struct WarmedGround {
  double inertia_j_m2_k_s =
      620;  ///< sqrt(k rho c) of the ground, 50 to 20000; of dry sand 620 (0.3 W/(m K), 1.28 MJ/(m^3 K))
  double to_air_w_m2_k = 8;  ///< heat that it loses to air and sky per kelvin, 0 to 500

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const WarmedGround&) const = default;
};

/// sqrt(k rho c) [J m^-2 K^-1 s^-1/2].
[[nodiscard]] double thermal_inertia(const GroundProperties& ground) noexcept;

/// exp(x^2) erfc(x) for x >= 0, within 2e-15 of 1 relative up to 5 and 1e-10 beyond; 0 at infinity.
[[nodiscard]] double scaled_erfc(double x) noexcept;

/// An animal or a person that lies on the ground.
struct Lying {
  double body_k = 309;  ///< within
  /// From there to the ground, 0.001 to 10: tissue 0.08 and flattened hair 0.1 (estimate).
  double contact_m2_k_w = 0.18;
  double time_s = 3600;  ///< for which it lay, at least 0

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const Lying&) const = default;
};

/// Excess of the ground below a lying body when it gets up [K]: (body - ground) (1 - exp(b^2) erfc(b)), b = sqrt(time) /
/// (contact * inertia): a half space with a convective boundary (Carslaw and Jaeger, Conduction of Heat in Solids, 1959).
[[nodiscard]] double bed_excess_k(const Lying& lying, const WarmedGround& ground, double ground_k) noexcept;

/// Share of that excess which is left after a time: (2 / pi) asin sqrt(lain / (lain + since)), exact for ground of one
/// temperature at its surface while the body lay and without loss afterwards, times exp(h^2) erfc(h), h = to_air
/// sqrt(since) / inertia, exact for a body that lay forever. Within 0.05 of a computation in layers; see the test.
[[nodiscard]] double bed_share_left(double lain_s, double since_s, const WarmedGround& ground) noexcept;

/// A camp fire. Its numbers are estimates unless noted.
struct CampFire {
  double diameter_m = 0.6;           ///< of its bed, 0.1 to 5
  double burn_rate_kg_m2_s = 0.015;  ///< wood of a square metre of bed, 0 to 0.1
  double radiant_share = 0.3;        ///< of its power, 0 to 1; 0.4 is a default for pool fires (RAPID-N, JRC)
  double flame_k = 1150;             ///< 800 to 1500; 1023 to 1370 K (popular pages)
  double flame_absorption_m = 0.8;   ///< of its flames per metre, 0 to 10
  double ember_k = 1050;      ///< 600 to 1400; 1023 to 1223 K glowing, 770 to 870 K dark red (popular pages)
  double ember_share = 0.35;  ///< of its bed that glows; ash hides the rest, 0 to 1
  double ash_k = 620;         ///< surface of ash above embers, 300 to 1000
  double emissivity =
      0.95;  ///< of embers and ash, above 0 to 1; charcoal powder 0.96 (Craftsman 81998 manual)
  double burning_s = 7200;  ///< duration of burning, at least 0

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const CampFire&) const = default;
};

/// Heat of its flames [W]: burning rate times 15 MJ/kg (dry wood; estimate).
[[nodiscard]] double fire_power_w(const CampFire& fire) noexcept;

/// Height of its flames [m]: 0.235 Q^0.4 - 1.02 D, Q in kW (Heskestad; coefficients from memory, so estimate); at least 0.
[[nodiscard]] double flame_height_m(const CampFire& fire) noexcept;

/// Emissivity of its flames seen across the bed: 1 - exp(-absorption * diameter).
[[nodiscard]] double flame_emissivity(const CampFire& fire) noexcept;

/// Temperature of a blackbody that radiates as much over all wavelengths as the burning bed of embers and ash [K].
[[nodiscard]] double bed_mean_k(const CampFire& fire) noexcept;

/// Irradiance of level ground at a distance from the bed's centre [W m^-2]: a point source of the radiant power at half
/// of the flames' height, at least 0.1 m. Within the bed, that at its edge.
[[nodiscard]] double fire_irradiance_w_m2(const CampFire& fire, double distance_m) noexcept;

/// Temperature of the ground around a burning fire [K]: balance of its radiation with air, sky and the heat conducted
/// into the ground, inertia / sqrt(pi time) per kelvin, within 1000 K. An infinite time: steady state, no conduction.
/// @param undisturbed_k  without the fire
[[nodiscard]] double fireside_ground_k(const CampFire& fire, const Surroundings& around,
                                       const GroundProperties& ground, double undisturbed_k,
                                       double distance_m) noexcept;

/// Temperature of the ash bed's surface after the flames went out [K]. The embers' power decays to 1/e in `ember_s`;
/// the ground below returns heat that it took up during the fire.
/// @param since_s  at least 0
[[nodiscard]] double ash_bed_k(const CampFire& fire, const Surroundings& around,
                               const GroundProperties& ground, double undisturbed_k, double since_s,
                               double ember_s = 2400) noexcept;

}  // namespace thermal
