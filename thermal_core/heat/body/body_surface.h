#pragma once

#include <string>

#include "heat/surface/surface_balance.h"
#include "heat/weather/forcing.h"

namespace thermal {

/// Weather and surroundings of a body at one moment.
struct Surroundings {
  Forcing forcing;
  double ground_k = 0;  ///< temperature of the ground around
  double sky_view =
      1;  ///< share of the sky that nothing hides, 0 to 1; what hides it has the temperature of the air
  double sunlit = 1;  ///< share of the sun's beam that reaches the body, 0 to 1
};

/// Radiation that arrives at a sloped surface [W m^-2]: the sun's beam averaged over all azimuths, the rest as
/// incoming_at().
/// @param normal_z  of the surface's unit normal: 1 faces the sky, -1 the ground; clamped to that
[[nodiscard]] Incoming incoming_on_slope(const Surroundings& around, double normal_z) noexcept;

/// The same for a surface with a unit normal.
[[nodiscard]] Incoming incoming_on(const Surroundings& around, const EastNorthUp& normal) noexcept;

/// How the surface of a person, an animal or a small object exchanges heat with what is around it.
struct BodySurface {
  double albedo = 0.3;       ///< share of sunlight that it reflects, 0 to 1
  double emissivity = 0.97;  ///< over all wavelengths, above 0 to 1
  double open_view = 1;      ///< share of its view that is not the body itself, above 0 to 1
  double area_factor = 1;    ///< outer area over the area through which heat comes from within, 1 to 3
  double diameter_m = 0;     ///< of a cylinder in the wind, 0.002 to 5; 0: a person, as ISO 7730 has it
  double wet = 0;            ///< share of what a wet surface evaporates, 0 to 1; dew falls on all

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const BodySurface&) const = default;
};

/// Heat that reaches a surface from the body within, per area below the surface.
struct HeatWithin {
  double inside_k = 0;
  double w_m2_k = 0;       ///< conductance from there; 0: none, infinite: the surface has inside_k
  double source_w_m2 = 0;  ///< additional heating
};

/// Heat transfer coefficient of a body to air [W m^-2 K^-1]: the larger of natural convection, 2.38 |dT|^0.25 (ISO
/// 7730), and forced convection: 12.1 sqrt(wind) for a person (ISO 7730), or Nu = 0.24 Re^0.6 for a cylinder (Gates,
/// Biophysical Ecology, 2003; Re 1e3 to 5e4, used for all).
[[nodiscard]] double body_convection(const BodySurface& surface, const Forcing& forcing,
                                     double surface_k) noexcept;

/// Net heat flux into a surface at `surface_k`, from outside and within [W m^-2 of the area below it], and its
/// derivative by temperature (always negative; that of evaporation without the change of convection).
[[nodiscard]] SurfaceFlux body_flux(const BodySurface& surface, const HeatWithin& within,
                                    const Forcing& forcing, const Incoming& incoming,
                                    double surface_k) noexcept;

/// Temperature at which body_flux() is 0 [K]: the balance of ISO 7730 with the sun and evaporation added, with the
/// body's own heat storage left out. An infinite conductance from within gives inside_k; otherwise as
/// balanced_temperature_k().
[[nodiscard]] double body_surface_k(const BodySurface& surface, const HeatWithin& within,
                                    const Forcing& forcing, const Incoming& incoming) noexcept;

}  // namespace thermal
