#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "imaging/ground/temperatures.h"
#include "imaging/ground/texture.h"
#include "imaging/ground/warm_spots.h"
#include "imaging/row_terms.h"
#include "radiometry/radiance_table.h"
#include "scene/variation_field.h"

namespace thermal {

/// Step of tabulated depths in crowns.
inline constexpr double kCrownStepM = 0.25;

/// Step of tabulated depths of water.
inline constexpr double kWaterStepM = 0.0625;

/// Sky view of leaves at an unknown depth in their crown.
inline constexpr double kMiddleOfCrown = 0.6;

/// Temperatures of one surface, or their rates of change.
struct SurfaceWarmth {
  static constexpr std::size_t kDepths =
      33;  ///< nodes of a crown, kCrownStepM apart, or of water, kWaterStepM apart

  float temperature_k = 0;                             ///< where nothing more specific applies
  std::array<float, Orientation::kTerms> by_normal{};  ///< see Orientation
  std::array<float, 3> sun{};                          ///< the same
  std::array<float, kDepths> by_depth_k{};
};

/// How the temperature of a surface depends on exposure under the weather.
struct HeatedSurface {
  enum class Kind : std::uint8_t {
    even,      ///< temperature_k
    ground,    ///< by its position on the maps
    oriented,  ///< by its normal
    crown,     ///< leaves: by their depth below the top of the plants there
    water      ///< by its depth on the maps, if they have water
  };

  Kind kind = Kind::even;
  float steepest = 1;    ///< largest horizontal part of a normal; steeper normals are clamped to it
  SurfaceWarmth middle;  ///< in the middle of its span
  SurfaceWarmth per_h;   ///< change per hour
  float variation_stddev_k = 0;
  float per_correlation_length = 0;  ///< [1/m]
  std::size_t table = 0;             ///< of radiance, among the tables
};

/// A time span of a clip in which temperatures are linear.
struct HeatSpan {
  double middle_h = 0;                  ///< offset from the clip's midpoint [h]
  double hours = 0;                     ///< duration
  std::vector<HeatedSurface> surfaces;  ///< the sky's is unused
  std::optional<GroundTexture> ground;  ///< empty without maps
};

/// Properties of the ground throughout a clip, with maps.
struct GroundDetail {
  CrownTops crown_tops;
  WaterDepths waters;
  GroundWarp warp;
};

/// The temperatures of a clip's surfaces by the heat balance.
struct SceneHeat {
  /// At least one, in order; the first and the last extend beyond the clip.
  std::vector<HeatSpan> spans;
  WarmSpots spots{{}};                 ///< of the ground, with maps
  std::optional<GroundDetail> ground;  ///< empty without maps

  /// Temperature at the clip's midpoint of a surface with uniform temperature.
  [[nodiscard]] float middle_k(std::size_t surface) const;
};

/// Emission of surfaces whose temperature follows the weather, with the fractal field on those that have one. All
/// arguments must outlive the term. Depths that are not positive and finite give a surface's own temperature.
/// Temperatures beyond the tables, such as those of fires, cost a hundred times as much.
[[nodiscard]] RowTerm heated_emission(const SceneHeat& heat,
                                      const std::vector<std::unique_ptr<RadianceTable>>& tables,
                                      const VariationField& field);

/// Replaces the sky view of ground, computed from its normal, by that of the maps, which includes crowns and relief.
/// Must follow heated_emission(), with maps, and orientation().
[[nodiscard]] RowTerm mapped_sky_view();

}  // namespace thermal
