#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "io/json/file.h"
#include "scene/weather.h"

namespace thermal {

/// The weather that a config asks for in a season: the season's, with what `weather` of the checked document replaces.
/// Its air is that of Table 1's nights, or `air_temperature_k`.
[[nodiscard]] Weather read_weather(const Json& weather, Season season);

/// The same at a moment for the heat balance: local solar time is `weather.time` and `later_s` seconds; the air has the
/// temperature of its day at that time.
[[nodiscard]] Weather at_moment(Weather weather, double later_s);

/// Adds a line for each thing in `weather` that cannot be in one of the seasons: a date that no calendar has, a minimum of the air above its
/// maximum, a dew point above the air, air given twice.
void check_weather(const Json& weather, std::initializer_list<Season> seasons,
                   std::vector<std::string>& faults);

}  // namespace thermal
