#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "imaging/ground_temperatures.h"
#include "imaging/ground_warp.h"
#include "imaging/row_terms.h"
#include "imaging/warm_spots.h"
#include "radiometry/radiance_table.h"
#include "scene/variation_field.h"

namespace thermal {

/// Step of depths in crowns.
inline constexpr double kCrownStepM = 0.25;

/// Step of depths of water.
inline constexpr double kWaterStepM = 0.0625;

/// Sky view of leaves whose depth in their crown is not known.
inline constexpr double kMiddleOfCrown = 0.6;

/// The temperatures of one surface, or how fast they change.
struct SurfaceWarmth {
  static constexpr std::size_t kDepths =
      33;  ///< nodes of a crown, kCrownStepM apart, or of water, kWaterStepM

  float temperature_k = 0;                             ///< where nothing else is known
  std::array<float, Orientation::kTerms> by_normal{};  ///< see Orientation
  std::array<float, 3> sun{};                          ///< the same
  std::array<float, kDepths> by_depth_k{};
};

/// How the temperature of one surface is found where the weather makes it.
struct HeatedSurface {
  enum class Kind : std::uint8_t {
    even,      ///< temperature_k
    ground,    ///< by its place on the maps
    oriented,  ///< by its normal
    crown,     ///< leaves: by their depth below the top of the plants there
    water      ///< by its depth on the maps, where they have water
  };

  Kind kind = Kind::even;
  float steepest = 1;  ///< largest horizontal part of a normal that counts; steeper ones count as that steep
  SurfaceWarmth middle;  ///< half-way through the time that it is for
  SurfaceWarmth per_h;   ///< what an hour adds
  float variation_stddev_k = 0;
  float per_correlation_length = 0;  ///< [1/m]
  std::size_t table = 0;             ///< of radiance, among the tables
};

/// Some time of a clip, in which temperatures follow straight lines.
struct HeatSpan {
  double middle_h = 0;                  ///< than the middle of the clip
  double hours = 0;                     ///< that it lasts
  std::vector<HeatedSurface> surfaces;  ///< the sky's is unused
  std::optional<GroundTexture> ground;  ///< empty without maps
};

/// What the ground has throughout a clip, where maps of it are known.
struct GroundDetail {
  CrownTops crown_tops;
  WaterDepths waters;
  GroundWarp warp;
};

/// The temperatures of a clip's surfaces by the heat balance.
struct SceneHeat {
  /// At least one; they follow each other, and the first and the last hold beyond the clip.
  std::vector<HeatSpan> spans;
  WarmSpots spots{{}};                 ///< of the ground, with maps
  std::optional<GroundDetail> ground;  ///< empty without maps

  /// Temperature in the middle of the clip of a surface that is everywhere as warm.
  [[nodiscard]] float middle_k(std::size_t surface) const;
};

/// Emission of surfaces whose temperature follows the weather, with the fractal field on those that have one. All that
/// is passed outlives the term. Depths that are not positive and finite give a surface's own temperature. What is hotter
/// than the tables, such as fires, costs a hundred times as much.
[[nodiscard]] RowTerm heated_emission(const SceneHeat& heat,
                                      const std::vector<std::unique_ptr<RadianceTable>>& tables,
                                      const VariationField& field);

/// Replaces the sky view of ground, by its normal, by that of the maps, of what level ground sees past crowns and
/// relief. Must follow heated_emission(), with maps, and orientation().
[[nodiscard]] RowTerm mapped_sky_view();

}  // namespace thermal
