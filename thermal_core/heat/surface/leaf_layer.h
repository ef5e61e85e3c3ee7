#pragma once

#include "heat/surface/balance_search.h"
#include "heat/surface/exchange.h"
#include "heat/surface/properties.h"
#include "heat/surface/surface_balance.h"

namespace thermal {

/// Share of even radiation from all of the sky that passes leaves of all directions: 2 E3(LAI / 2), the mean of
/// exp(-LAI / (2 sin h)) over the sky. Less than passes straight down, exp(-LAI / 2).
/// @param leaf_area_index  area of leaves above an area of ground, 0 to 100
[[nodiscard]] double diffuse_through_leaves(double leaf_area_index) noexcept;

/// How leaves stand: as a cover of the ground, or as single plants, through which the air of the open ground blows.
enum class Stand { cover, alone };

/// The balance of a layer of leaves above ground, per area of ground.
///
/// Leaves up to 2 m high that cover the ground exchange heat through the air above them as rough ground does, so they
/// get cold in calm nights; those of trees and of plants that stand alone are in the open wind. The wind among leaves is
/// half of that above (estimate).
class LeafLayer {
 public:
  explicit LeafLayer(const CanopyProperties& canopy, Stand stand = Stand::cover) noexcept;

  /// The weather among the leaves of a plant that stands alone on open ground: the air half-way up the plant.
  [[nodiscard]] Forcing among(const Forcing& forcing, double open_ground_k) const noexcept;

  /// Net heat flux into the leaves, and its derivative by their temperature.
  [[nodiscard]] SurfaceFlux flux(const Forcing& forcing, const Incoming& above, double ground_k,
                                 double leaves_k) const noexcept;

  /// Radiation that arrives at the ground below.
  [[nodiscard]] Incoming below(const Incoming& above, double leaves_k) const noexcept;

 private:
  CanopyProperties canopy_;
  Stand stand_;
  double shade_;   ///< share of sunlight that leaves take or reflect
  double screen_;  ///< share of longwave radiation that leaves exchange
  GroundExchange exchange_;
};

}  // namespace thermal
