#pragma once

#include <array>
#include <cstdint>

#include "heat/weather/day_weather.h"

namespace thermal {

/// How much the sunbeams of each hour of a day still warm the ground at a moment: what the ground got in that hour, over
/// the root of the time since (the response of a thick body to heat at its surface). The sum is 1; all 0 where the sun
/// does not rise. Entry k is the hour from k to k + 1 o'clock; hours still to come are those of the day before.
using SunMemory = std::array<float, 24>;
/// The weights at a local solar time.
[[nodiscard]] SunMemory sun_memory(const DayWeather& weather, double solar_h) noexcept;

/// Share of the day's sunbeams that a place gets, by the hours in which it is sunlit: bit k is the hour from k o'clock.
[[nodiscard]] float sunlit_share(const SunMemory& memory, std::uint32_t hours) noexcept;

}  // namespace thermal
