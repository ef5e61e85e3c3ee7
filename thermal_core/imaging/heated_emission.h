#pragma once

#include <array>
#include <memory>
#include <vector>

#include "imaging/ground_temperatures.h"
#include "imaging/row_terms.h"
#include "imaging/warm_spots.h"
#include "radiometry/radiance_table.h"
#include "scene/variation_field.h"

namespace thermal {

/// How the temperature of one surface is found where the weather makes it.
struct HeatedSurface {
  enum class Kind {
    even,      ///< temperature_k
    cover,     ///< of the ground: by its place on the maps
    oriented,  ///< by its normal
    crown      ///< leaves: by their depth below the top of the plants there
  };
  static constexpr std::size_t kDepths = 33;  ///< nodes of a crown, a quarter of a metre apart

  Kind kind = Kind::even;
  float temperature_k = 0;                             ///< where nothing else is known
  std::int32_t cover = -1;                             ///< number among the covers of the ground
  std::array<float, Orientation::kTerms> by_normal{};  ///< see Orientation
  std::array<float, 3> sun{};                          ///< the same
  float steepest = 1;  ///< largest horizontal part of a normal that counts; steeper ones count as that steep
  std::array<float, kDepths> by_depth_k{};
  float rate_k_h = 0;  ///< how fast it warms
  float variation_stddev_k = 0;
  float per_correlation_length = 0;  ///< [1/m]
  std::size_t table = 0;             ///< of radiance, among the tables
};

/// Emission of surfaces whose temperature follows the weather, with the fractal field on those that have one. `ground`
/// is null without maps; all outlive the term. Depths that are not positive and finite give temperature_k. `spots` warm
/// the ground's covers, with maps. What is hotter than the tables, such as fires, costs a hundred times as much.
[[nodiscard]] RowTerm heated_emission(std::vector<HeatedSurface> surfaces,
                                      const std::vector<std::unique_ptr<RadianceTable>>& tables,
                                      const GroundTemperatures* ground, const WarmSpots& spots,
                                      const VariationField& field);

/// Replaces the sky view of ground, by its normal, by that of the maps, of what level ground sees past crowns and relief.
/// Must follow heated_emission() and orientation(); `ground` outlives the term.
[[nodiscard]] RowTerm mapped_sky_view(const std::vector<HeatedSurface>& surfaces,
                                      const GroundTemperatures& ground);

}  // namespace thermal
