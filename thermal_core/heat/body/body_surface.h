#pragma once

#include <string>

#include "heat/surface/surface_balance.h"
#include "heat/weather/forcing.h"

namespace thermal {

/// The weather of a moment, and what stands around a body.
struct Surroundings {
  Forcing forcing;
  double ground_k = 0;  ///< temperature of the ground around
  double sky_view =
      1;  ///< share of the sky that nothing hides, 0 to 1; what hides it has the temperature of the air
  double sunlit = 1;  ///< share of the sun's beam that reaches the body, 0 to 1
};

/// What arrives at a surface of a slope [W m^-2]: of the sun's beam the mean over all azimuths, all else as
/// incoming_at() has it.
/// @param normal_z  of the surface's unit normal: 1 faces the sky, -1 the ground; clamped to that
[[nodiscard]] Incoming incoming_on_slope(const Surroundings& around, double normal_z) noexcept;

/// The same for a surface that faces a direction, a unit vector.
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

/// Heat that reaches a surface from within, per area below it.
struct HeatWithin {
  double inside_k = 0;
  double w_m2_k = 0;       ///< conductance from there; 0: none, infinite: the surface has inside_k
  double source_w_m2 = 0;  ///< besides
};

/// Heat that air takes from a body per kelvin of difference [W m^-2 K^-1]: the larger of 2.38 |dT|^0.25 (ISO 7730) and
/// what wind takes: 12.1 sqrt(wind) from a person (ISO 7730), or Nu = 0.24 Re^0.6 from a cylinder (Gates, Biophysical
/// Ecology, 2003; Re 1e3 to 5e4, used for all).
[[nodiscard]] double body_convection(const BodySurface& surface, const Forcing& forcing,
                                     double surface_k) noexcept;

/// Heat that a surface at `surface_k` gets from outside and within [W m^-2 of the area below it], and how that changes
/// with its temperature (always negative; that of evaporation without the change of convection).
[[nodiscard]] SurfaceFlux body_flux(const BodySurface& surface, const HeatWithin& within,
                                    const Forcing& forcing, const Incoming& incoming,
                                    double surface_k) noexcept;

/// Temperature at which body_flux() is 0 [K]: the balance of ISO 7730 with the sun and evaporation added, with the
/// body's own heat storage left out. Infinite heat from within gives its temperature; otherwise as
/// balanced_temperature_k().
[[nodiscard]] double body_surface_k(const BodySurface& surface, const HeatWithin& within,
                                    const Forcing& forcing, const Incoming& incoming) noexcept;

}  // namespace thermal
