#pragma once

#include "heat/surface/balance_search.h"
#include "heat/surface/exchange.h"
#include "heat/surface/properties.h"
#include "heat/weather/forcing.h"

namespace thermal {

/// Orientation and exposure of a piece of a surface.
struct Site {
  EastNorthUp normal = {0, 0, 1};  ///< of unit length
  double sky_view = 1;             ///< share of the sky that its slope leaves and nothing hides, 0 to 1
  double sunlit = 1;               ///< share of the sun's beam that reaches it, 0 to 1
};

/// Radiation that arrives at a surface [W m^-2].
struct Incoming {
  double sun_w_m2 = 0;
  double longwave_w_m2 = 0;
};

/// Radiation that arrives at a site. Obstacles before the sky have the temperature of the air; the share of the view
/// below the horizon is ground at `ground_k`. Both reflect a fifth of their sunlight (estimate).
[[nodiscard]] Incoming incoming_at(const Forcing& forcing, const Site& site, double ground_k) noexcept;

/// Heat that goes into a body below its surface at the end of a step: slope_w_m2_k * surface_k - offset_w_m2.
struct HeatUptake {
  double slope_w_m2_k = 0;
  double offset_w_m2 = 0;
};

/// The balance of sunlight, longwave radiation, heat and vapour at a surface.
class SurfaceBalance {
 public:
  explicit SurfaceBalance(const SurfaceProperties& surface) noexcept;

  /// Net heat flux from above; its derivative neglects the change of the exchange with air.
  [[nodiscard]] SurfaceFlux flux(const Forcing& forcing, const Incoming& incoming,
                                 double surface_k) const noexcept;

  /// Temperature at which the flux from above equals the uptake: see balanced_temperature_k().
  [[nodiscard]] double balanced_k(const Forcing& forcing, const Incoming& incoming, const HeatUptake& uptake,
                                  double guess_k) const noexcept;

 private:
  [[nodiscard]] double exchange(const Forcing& forcing, double surface_k) const noexcept;

  SurfaceProperties surface_;
  GroundExchange ground_exchange_;
};

}  // namespace thermal
