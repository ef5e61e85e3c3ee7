#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "imaging/actor_states.h"
#include "imaging/ground/temperatures.h"
#include "imaging/heated_emission.h"
#include "imaging/heated_surfaces.h"
#include "imaging/surfaces.h"
#include "scene/manifest.h"
#include "scene/weather.h"

namespace thermal {

/// Appearance of a material of the ground at a temperature [K].
struct GroundAppearance {
  GroundShift shift;       ///< see SoilAppearance
  double variation_k = 0;  ///< see GroundPart
};
/// The appearance of each material, by its name.
using GroundAppearanceOf = std::function<GroundAppearance(const std::string& material, double temperature_k)>;

/// Temperatures of a clip's surfaces by the heat balance. Surfaces whose material has no heat properties have their
/// part's temperature on Table 1's line. A clip is one span, or several where the change of open level surfaces is
/// nonlinear by more than 10 mK, as at sunrise; none is shorter than a sixteenth of the clip.
/// @param states  of actors, by the class of a surface
[[nodiscard]] SceneHeat heat_of_scene(const std::vector<Surface>& surfaces,
                                      const std::vector<ActorState>& states, const HeatSettings& settings,
                                      const Weather& weather, const Manifest& manifest,
                                      const SceneHeatTerms& terms, const GroundAppearanceOf& appearance_of,
                                      std::uint32_t seed);

}  // namespace thermal
