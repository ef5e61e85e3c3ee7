#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "imaging/actor_states.h"
#include "imaging/ground_temperatures.h"
#include "imaging/heat_settings.h"
#include "imaging/heated_emission.h"
#include "imaging/heated_surfaces.h"
#include "imaging/surfaces.h"
#include "imaging/warm_spots.h"
#include "scene/manifest.h"
#include "scene/weather.h"

namespace thermal {

/// The temperatures of a clip's surfaces by the heat balance.
struct SceneHeat {
  std::vector<HeatSpan> spans;  ///< at least one; surfaces without their tables
  WarmSpots spots{{}};          ///< of the ground

  /// Temperature in the middle of the clip of a surface that is everywhere as warm.
  [[nodiscard]] float middle_k(std::size_t surface) const;
};

/// Works out how each surface's temperature is found. Surfaces whose material has no heat have the temperature of their
/// part by Table 1's line. A clip is one span, or several where open level surfaces bend by more than 10 mK from a
/// straight line, as at sunrise; none is shorter than a sixteenth of the clip.
/// @param states  of actors, by the class of a surface
[[nodiscard]] SceneHeat heat_of_scene(const std::vector<Surface>& surfaces,
                                      const std::vector<ActorState>& states, const HeatSettings& settings,
                                      const Weather& weather, const Manifest& manifest,
                                      const SceneHeatTerms& terms, std::uint32_t seed);

}  // namespace thermal
