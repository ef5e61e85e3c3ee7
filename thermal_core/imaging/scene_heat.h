#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "imaging/actor_states.h"
#include "imaging/ground_temperatures.h"
#include "imaging/heat_settings.h"
#include "imaging/heated_emission.h"
#include "imaging/surfaces.h"
#include "imaging/warm_spots.h"
#include "scene/manifest.h"
#include "scene/weather.h"

namespace thermal {

/// The temperatures of a clip's surfaces in its middle, by the heat balance.
struct SceneHeat {
  std::vector<HeatedSurface> surfaces;         ///< without their tables; the sky's is unused
  std::unique_ptr<GroundTemperatures> ground;  ///< null without maps
  WarmSpots spots{{}};                         ///< of the ground
};

/// What the passes of a scene allow, and which terms it keeps.
struct SceneHeatTerms {
  bool parts = false;
  bool variation = false;  ///< depths and poses are known
  bool normals = false;    ///< they and the poses are known; otherwise ground faces up, and bodies sideways
};

/// Works out how each surface's temperature is found. Surfaces whose material has no heat have the temperature of their
/// part by Table 1's line. @param states  of actors, by the class of a surface
[[nodiscard]] SceneHeat heat_of_scene(const std::vector<Surface>& surfaces,
                                      const std::vector<ActorState>& states, const HeatSettings& settings,
                                      const Weather& weather, const Manifest& manifest,
                                      const SceneHeatTerms& terms, std::uint32_t seed);

/// Temperatures of materials by the heat balance on open level ground, by material and part ("" is the whole): those of
/// materials that have a heat or a body's heat. Leaves are those in the middle of their crowns; actors stand upright.
[[nodiscard]] std::map<std::string, std::map<std::string, double>> open_temperatures_k(
    const std::vector<const Material*>& materials, const MaterialLibrary& library, const Weather& weather);

/// The heat of all materials of a library that have one.
[[nodiscard]] std::map<std::string, MaterialHeat> heat_of_materials(const MaterialLibrary& materials);

}  // namespace thermal
