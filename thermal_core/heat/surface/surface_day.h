#pragma once

#include <span>
#include <vector>

#include "heat/surface/conduction.h"
#include "heat/surface/material_heat.h"
#include "heat/surface/surface_balance.h"
#include "heat/weather/forcing.h"

namespace thermal {

/// How finely a day is computed. ACCURACY.md has the error of these values beside their speed.
struct HeatSteps {
  int per_day = 288;   ///< steps of a day, 24 to 86400
  Layers layers = {};  ///< of ground
  /// A day is settled if no surface temperature differs more from the day before, and no more heat stays in the body than
  /// such a difference gives off (4 W m^-2 K^-1).
  double settled_k = 0.0005;
  int most_days = 60;  ///< after which a day is taken as it is

  [[nodiscard]] bool operator==(const HeatSteps&) const = default;
};

/// Temperatures of a surface over a day that repeats itself.
struct SurfaceDay {
  std::vector<double> surface_k;  ///< at the end of each step from 0:00 on
  std::vector<double> layers_k;  ///< of the ground, or of that below leaves, at the day's end; see Conduction
  double closure_w_m2 = 0;       ///< mean heat that went into the body over the day; 0 if it repeats itself
  double unsettled_k = 0;        ///< largest difference from the day before
  int days = 0;                  ///< computed until it settled

  /// At a local solar time, by straight lines between the steps; any finite number of hours.
  [[nodiscard]] double at_k(double solar_h) const noexcept;
};

/// The weather of a day, step by step, and the temperature of open level ground, which slopes and standing bodies face
/// and which cools the air near it; empty: that of the air.
struct DayAround {
  std::span<const Forcing> forcing;
  std::span<const double> ground_k = {};

  [[nodiscard]] double ground_at_k(std::size_t step) const noexcept {
    return ground_k.empty() ? forcing[step].air_k : ground_k[step];
  }
};

/// Ground, rock, a trunk. The first day starts as `like` ended, a day of a similar surface in the same weather, or from
/// the mean of the air; starting from a similar surface needs fewer days, and the result differs by HeatSteps::settled_k.
[[nodiscard]] SurfaceDay day_of_ground(const GroundProperties& properties, const Site& site,
                                       const DayAround& around, const HeatSteps& steps,
                                       const SurfaceDay* like = nullptr);

/// Water, a sheet of metal.
[[nodiscard]] SurfaceDay day_of_slab(const SlabProperties& properties, const Site& site,
                                     const DayAround& around, const HeatSteps& steps,
                                     const SurfaceDay* like = nullptr);

/// A layer of leaves and the ground below it. Leaves above 2 m are in the air of their height: see StableAir.
struct CanopyDay {
  SurfaceDay leaves;
  SurfaceDay ground;
};
/// The settled day of leaves and of the ground below them. `like`: leaves of a similar canopy.
[[nodiscard]] CanopyDay day_of_canopy(const CanopyProperties& canopy, const GroundProperties& ground,
                                      const Site& site, const DayAround& around, const HeatSteps& steps,
                                      Stand stand = Stand::cover, const SurfaceDay* like = nullptr);

/// What a thermal camera sees of leaves and the ground between them from straight above, as one blackbody [K].
[[nodiscard]] double seen_from_above_k(const CanopyProperties& canopy, double leaves_k,
                                       double ground_k) noexcept;

}  // namespace thermal
