#pragma once

#include <optional>
#include <string_view>

#include "heat/weather/forcing.h"
#include "radiometry/atmosphere.h"

namespace thermal {

/// The two nights of the published Table 1: air at 273 K in winter, at 293 K in summer.
enum class Season { winter, summer };

/// "summer" is summer; anything else is winter.
[[nodiscard]] constexpr Season season_of(std::string_view name) noexcept {
  return name == "summer" ? Season::summer : Season::winter;
}

/// Its name in configs: "winter" or "summer".
[[nodiscard]] constexpr std::string_view season_name(Season season) noexcept {
  return season == Season::winter ? "winter" : "summer";
}

/// Conditions of a clip, for the whole scene.
struct Weather {
  Air air;  ///< at the clip's time
  std::optional<double> vehicle_stopped_s =
      {};                  ///< since engines were switched off; empty: a value per vehicle
  DayWeather day = {};     ///< around the clip, for the heat balance
  double solar_h = 3;      ///< local solar time of the clip's middle
  double cold_pool_k = 0;  ///< how much colder the lowest ground of the scene is at night than the highest
  /// Whether the heat balance computes air.inversion_k at the cameras' heights; see with_inversion().
  bool inversion_by_balance = false;

  [[nodiscard]] bool operator==(const Weather&) const = default;
};

/// The nights of Table 1: winter 273 K and 60 % humidity, summer 293 K and 70 %, both clear, at 3:00. Their days are
/// those of southern Africa in 19 deg S, 9 July and 15 January: dry and clear in winter, two days after rain in summer
/// (estimates; the swing of air by 22 K and 10 K follows climate tables of Hwange and Maun).
[[nodiscard]] inline Weather weather_of(Season season) {
  if (season == Season::winter) {
    return {.air = {273, 0.6, 0},
            .day = {.sun = {-19, 190},
                    .air_min_k = 271.37,
                    .air_max_k = 293.77,
                    .air_hourly_k = {},
                    .vapour_hpa = 3.62,
                    .night_wind_m_s = 1,
                    .day_wind_m_s = 3.5,
                    .rain_days_ago = 60}};
  }
  return {.air = {293, 0.7, 0},
          .day = {.sun = {-19, 15},
                  .air_min_k = 292.47,
                  .air_max_k = 302.67,
                  .air_hourly_k = {},
                  .vapour_hpa = 16.15,
                  .night_wind_m_s = 1,
                  .day_wind_m_s = 3,
                  .rain_days_ago = 2}};
}

}  // namespace thermal
