#pragma once

#include <map>
#include <string>
#include <vector>

#include "heat/surface/material_heat.h"
#include "imaging/budget.h"
#include "scene/material.h"

namespace thermal {

/// Fills the temperatures of one set of conditions: those of materials with heat properties, on open level ground, by
/// material and part ("" is the whole); leaves are mid-crown, actors stand upright. Also the shifts by exposure: shade
/// of crowns, moist shores, depth in a crown; slopes and sides.
void heat_conditions(const std::vector<SceneOutline::Cover>& covers, const MaterialLibrary& library,
                     SceneOutline::Conditions& viewing);

/// Heat properties of all materials of a library that have them.
[[nodiscard]] std::map<std::string, MaterialHeat> heat_of_materials(const MaterialLibrary& materials);

}  // namespace thermal
