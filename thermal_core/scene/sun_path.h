#pragma once

#include <array>

namespace thermal {

/// A unit vector or a normal: east, north, up.
using EastNorthUp = std::array<double, 3>;

/// The day on which the sun is looked at, and from where.
struct SunPath {
  double latitude_deg = -19;  ///< -90 (south pole) to 90
  int day_of_year = 190;      ///< 1 to 366

  [[nodiscard]] bool operator==(const SunPath&) const = default;
};

/// Direction to the sun's centre, also below the horizon, without refraction. Its declination is within 0.0006 rad of
/// an almanac (Spencer, Search 2, 172, 1971).
/// @param solar_h  local solar time [h], any finite value; at 12 the sun is highest.
[[nodiscard]] EastNorthUp sun_direction(const SunPath& path, double solar_h) noexcept;

/// Directions to the sun in the middle of each hour: k + 0.5 of local solar time.
using SunHours = std::array<EastNorthUp, 24>;
[[nodiscard]] SunHours sun_hours(const SunPath& path) noexcept;

}  // namespace thermal
