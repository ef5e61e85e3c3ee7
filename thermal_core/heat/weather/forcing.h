#pragma once

#include <array>
#include <cstdint>
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

/// The weather that acts on surfaces at one moment.
struct Forcing {
  double air_k = 0;       ///< at 2 m above the ground
  double wind_m_s = 0;    ///< the same
  double vapour_hpa = 0;  ///< partial pressure of vapour, at most saturation
  double pressure_hpa = 0;
  double sky_w_m2 = 0;      ///< longwave radiation of the whole sky on level ground
  EastNorthUp sun{};        ///< direction to it
  double beam_w_m2 = 0;     ///< of the sun, on a surface that faces it
  double diffuse_w_m2 = 0;  ///< of the daylight sky, on level ground
  double global_w_m2 = 0;   ///< both, on level ground
};

/// Emissivity of the sky over all wavelengths, as level ground receives it (Prata, QJRMS 122, 1127, 1996):
/// 1 - (1 + w) exp(-sqrt(1.2 + 3 w)), w = 46.5 e / T; clouds fill 0.84 of what is missing. Not what a camera sees in
/// its band: see radiometry/atmosphere.h.
[[nodiscard]] double broadband_sky_emissivity(double air_k, double vapour_hpa,
                                              double cloud_fraction) noexcept;

/// Temperature of the air over the day. From sunrise to sunset a sine that is highest 1.86 h after noon, then a decay
/// to the minimum at sunrise (Parton and Logan, Agric. Meteorol. 23, 205, 1981; a = 1.86 h, b = 2.2, the decay scaled
/// to end at the minimum). Where the sun does not rise or set, a cosine that is highest at 14:00. With air_hourly_k,
/// straight lines between the hours.
[[nodiscard]] double air_temperature_k(const DayWeather& weather, double solar_h) noexcept;

/// Share of the sky that clouds cover at a local solar time; with cloud_hourly, straight lines between the hours.
[[nodiscard]] double cloud_fraction_at(const DayWeather& weather, double solar_h) noexcept;

/// The forcing at a local solar time, any finite number of hours; 25 is 1. `weather` must be valid.
/// Sunlight through a clear sky: 0.75 + 2e-5 z of that above the air (FAO-56, equation 37), a fifth of it diffuse
/// (estimate); clouds take 0.65 n^2 of it (Kasten and Czeplak 1980 have 0.75 n^3.4) and make a share of 0.6 n more of
/// it diffuse (estimates). Wind rises from its night value to that of noon as a sine.
[[nodiscard]] Forcing forcing_at(const DayWeather& weather, double solar_h) noexcept;

/// The forcing at the ends of `steps` equal steps of a day from 0:00 on.
[[nodiscard]] std::vector<Forcing> forcing_of_day(const DayWeather& weather, int steps);

/// How much the sunbeams of each hour of a day still warm the ground at a moment: what the ground got in that hour, over
/// the root of the time since (the response of a thick body to heat at its surface). The sum is 1; all 0 where the sun
/// does not rise. Entry k is the hour from k to k + 1 o'clock; hours still to come are those of the day before.
using SunMemory = std::array<float, 24>;
/// The weights at a local solar time.
[[nodiscard]] SunMemory sun_memory(const DayWeather& weather, double solar_h) noexcept;

/// Share of the day's sunbeams that a place gets, by the hours in which it is sunlit: bit k is the hour from k o'clock.
[[nodiscard]] float sunlit_share(const SunMemory& memory, std::uint32_t hours) noexcept;

}  // namespace thermal
