#pragma once

#include <memory>

#include "heat/surface/heat_of_day.h"
#include "scene/ground_maps.h"

namespace thermal {

/// Inputs of temperatures by the heat balance: the weather's day, and maps of the ground.
struct HeatSettings {
  std::shared_ptr<const HeatOfDay> day;
  std::shared_ptr<const GroundMaps> ground;  ///< null: open level ground everywhere

  [[nodiscard]] bool operator==(const HeatSettings&) const = default;
};

}  // namespace thermal
