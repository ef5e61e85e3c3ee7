#pragma once

#include <vector>

#include "heat/weather/sun.h"

namespace thermal {

/// The weather of a day that repeats itself, as it was for the days before, and where on Earth it is.
struct DayWeather {
  SunPath sun;
  double elevation_m = 900;          ///< above the sea, -500 to 9000
  double air_min_k = 270.6;          ///< at sunrise
  double air_max_k = 293;            ///< in the early afternoon
  std::vector<double> air_hourly_k;  ///< air at 0:00, 1:00, … 23:00, instead of both; empty: from both
  double vapour_hpa = 3.63;          ///< partial pressure of vapour all day, as far as the air can hold it
  double night_wind_m_s = 1;         ///< at 2 m above the ground
  double day_wind_m_s = 3.5;         ///< at noon
  double cloud_fraction = 0;         ///< 0 to 1
  std::vector<double> cloud_hourly =
      {};                     ///< the same at 0:00, 1:00, … 23:00, instead of it; empty: all day alike
  double rain_days_ago = 60;  ///< at least 0

  /// ConfigError with the key of weather if a value is outside its domain: temperatures 200 to 340 K and the minimum
  /// not above the maximum, vapour that the air cannot hold even at its warmest, wind 0 to 60 m/s.
  void validate() const;

  [[nodiscard]] bool operator==(const DayWeather&) const = default;
};

}  // namespace thermal
