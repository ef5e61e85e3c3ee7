#pragma once

#include <string>

#include "heat/surface/properties.h"

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

}  // namespace thermal
