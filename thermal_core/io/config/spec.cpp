#include "io/config/spec.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "heat/weather/forcing.h"
#include "heat/weather/humid_air.h"

namespace thermal {

Weather ClipSpec::weather_at(double time_s, bool heat_balance) const {
  Weather weather = settings->weather.at(static_cast<std::size_t>(season));
  if (!heat_balance) {
    weather.inversion_by_balance = false;  // Table 1's line says nothing of an inversion
    return weather;
  }
  weather.solar_h += time_s / 3600;
  const Forcing forcing = forcing_at(weather.day, weather.solar_h);
  weather.air.temperature_k = forcing.air_k;
  weather.air.relative_humidity = forcing.vapour_hpa / saturation_hpa(forcing.air_k);
  weather.air.cloud_fraction = cloud_fraction_at(weather.day, weather.solar_h);
  return weather;
}

ClipSpec FlightSpec::cut(ClipSpec clip) const {
  clip.season = season;
  clip.of_flight = id;
  clip.speed_m_s = speed_m_s;
  clip.settings = settings;
  return clip;
}

const ClipSpec& DatasetSpec::clip(const std::string& id, const std::string& where) const {
  const auto found = std::ranges::find(clips, id, &ClipSpec::id);
  if (found != clips.end()) return *found;
  std::vector<std::string> known;
  for (const ClipSpec& clip : clips) known.push_back(clip.id);
  throw ConfigError(fault(where, fmt::format("\"{}\"", id), "", "one of " + list_names(known)) +
                    did_you_mean(id, known));
}

const FlightSpec* DatasetSpec::flight(const std::string& id) const {
  const auto found = std::ranges::find(flights, id, &FlightSpec::id);
  return found == flights.end() ? nullptr : &*found;
}

std::vector<FlownWeather> flown_weather(const DatasetSpec& spec) {
  std::vector<FlownWeather> flown;
  const auto add = [&](const auto& one, double duration_s) {
    const Weather& weather = one.settings->weather.at(static_cast<std::size_t>(one.season));
    auto found = std::ranges::find_if(flown, [&](const FlownWeather& other) {
      return other.season == one.season && other.weather == weather;
    });
    if (found == flown.end())
      found = flown.insert(found, {.season = one.season, .weather = weather, .hours = {}});
    const double start_h = weather.solar_h + one.start_s / 3600;
    found->hours.emplace_back(start_h, start_h + duration_s / 3600);
  };
  for (const ClipSpec& clip : spec.clips) add(clip, clip.frames / clip.frame_rate_hz);
  for (const FlightSpec& flight : spec.flights) add(flight, flight.duration_s);
  std::ranges::stable_sort(flown, {}, &FlownWeather::season);
  return flown;
}

}  // namespace thermal
