#pragma once

#include "radiometry/atmosphere.h"
#include "scene/season.h"

namespace thermal {

/// The conditions of a night, for everything in the scene.
struct Weather {
  Air air;
  double vehicle_stopped_s = 3600;  ///< since engines were switched off

  [[nodiscard]] bool operator==(const Weather&) const = default;
};

/// The nights of Table 1: winter 273 K and 60 % humidity, summer 293 K and 70 %, both clear.
[[nodiscard]] constexpr Weather weather_of(Season season) noexcept {
  return season == Season::winter ? Weather{.air = {273, 0.6, 0}} : Weather{.air = {293, 0.7, 0}};
}

}  // namespace thermal
