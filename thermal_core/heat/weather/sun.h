#pragma once

#include <array>

namespace thermal {

/// A unit vector or a normal: east, north, up.
using EastNorthUp = std::array<double, 3>;

/// Latitude and day of the sun's path.
struct SunPath {
  double latitude_deg = -19;  ///< -90 (south pole) to 90
  int day_of_year = 190;      ///< 1 to 366

  /// ConfigError outside of these ranges.
  void validate() const;

  [[nodiscard]] bool operator==(const SunPath&) const = default;
};

/// Declination of the sun [rad] (Spencer, Search 2, 172, 1971), the same on a day of every year: within 0.008 rad of an
/// almanac, most of it because years begin up to a day apart from the sun's, 0.0006 rad from the series itself.
[[nodiscard]] double declination_rad(int day_of_year) noexcept;

/// Square of the mean distance of the sun over that of a day, 1 + 0.033 cos(2 pi J / 365): FAO-56 (Allen et al.
/// 1998), equation 23.
[[nodiscard]] double sun_nearness(int day_of_year) noexcept;

/// Time from sunrise to sunset [h], of the sun's centre and without refraction; 0 in the polar night, 24 where the sun
/// does not set. FAO-56, equations 25 and 34.
[[nodiscard]] double day_length_h(const SunPath& path) noexcept;

/// Direction to the sun's centre, also below the horizon.
/// @param solar_h  local solar time [h]; at 12 the sun is highest. Any finite value; 25 is 1.
[[nodiscard]] EastNorthUp sun_direction(const SunPath& path, double solar_h) noexcept;

/// Directions to the sun in the middle of each hour: k + 0.5 of local solar time.
using SunHours = std::array<EastNorthUp, 24>;
/// The directions of a day.
[[nodiscard]] SunHours sun_hours(const SunPath& path) noexcept;

/// Irradiance of a surface that faces the sun above the air, at the sun's mean distance [W m^-2]: 0.0820 MJ m^-2
/// min^-1 (FAO-56, equation 21).
inline constexpr double kSolarConstantWM2 = 0.0820e6 / 60;

}  // namespace thermal
