#pragma once

#include "heat/body/body_surface.h"
#include "heat/body/tissue.h"

namespace thermal {

/// Bare skin, or a hide or fur above it, of a warm-blooded body.
struct Coat {
  Tissue tissue = {};
  double coat_m2_k_w = 0;      ///< from the skin to the surface that is seen, 0 (bare) to 10
  double wet_when_bathed = 0;  ///< share of what a wet surface evaporates just after a bath, 0 to 1
  double drying_s = 1800;      ///< in which that share falls to 1/e, above 0 to 1e6
  BodySurface surface = {.albedo = 0.3, .emissivity = 0.98, .open_view = 0.9, .diameter_m = 0.5};

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const Coat&) const = default;
};

/// Evaporation as a share of a wet surface's: from the skin itself, and what is left of the bath.
/// @param since_bath_s  at least 0; infinite: never
[[nodiscard]] double wet_share(const Coat& coat, double since_bath_s) noexcept;

/// Additional insulation by the tissue of an animal at rest, against one that forages [m^2 K/W]: 0.1 in air up to 283
/// K, falling linearly to 0 at 293 K. An estimate: an elephant then gives off 1.7 times its basal rate in air of 273 K,
/// not 2.7; adult cattle have 0.12 to 0.25 in all (Nutrient Requirements of Beef Cattle, NRC 1996).
[[nodiscard]] double resting_tissue_m2_k_w(double air_k) noexcept;

/// Surface of a coat or of bare skin [K]. A person's air moves past it as past clothes; an animal that walks is cooled by
/// the wind alone, and one that stands is at rest.
[[nodiscard]] double coat_surface_k(const Coat& coat, Activity activity, double since_bath_s,
                                    const Forcing& forcing, const Incoming& incoming) noexcept;

/// A cold-blooded body, warmed by the water or ground that it rested in.
struct ColdBlooded {
  double above_k = 1;          ///< core above the water or ground that it came from, -20 to 20
  double tissue_m2_k_w = 0.1;  ///< from the core to the surface, above 0 to 10
  BodySurface surface = {.albedo = 0.2, .emissivity = 0.96, .open_view = 0.9, .diameter_m = 0.5};

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const ColdBlooded&) const = default;
};

/// @param refuge_k  temperature of the water or ground
[[nodiscard]] double cold_blooded_surface_k(const ColdBlooded& body, double refuge_k, const Forcing& forcing,
                                            const Incoming& incoming) noexcept;

}  // namespace thermal
