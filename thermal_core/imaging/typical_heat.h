#pragma once

#include <map>
#include <string>
#include <vector>

#include "heat/surface/material_heat.h"
#include "imaging/budget.h"
#include "scene/material.h"

namespace thermal {

/// Fills a night's temperatures: those of materials that have a heat or a body's heat, on open level ground, by
/// material and part ("" is the whole); leaves are those in the middle of their crowns, actors stand upright. And what
/// places do: shade of crowns, moist shores, the depth in a crown; slopes and sides.
void heat_night(const std::vector<SceneOutline::Cover>& covers, const MaterialLibrary& library,
                SceneOutline::Night& night);

/// The heat of all materials of a library that have one.
[[nodiscard]] std::map<std::string, MaterialHeat> heat_of_materials(const MaterialLibrary& materials);

}  // namespace thermal
