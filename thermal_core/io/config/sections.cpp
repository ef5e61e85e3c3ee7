#include "io/config/sections.h"

#include <chrono>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "heat/weather/forcing.h"
#include "heat/weather/humid_air.h"
#include "io/config/lens.h"
#include "io/config/sensor.h"
#include "io/json/camera.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

/// `otherwise` is the model's choice for terms that the config leaves open.
TermChoices read_terms(const Json& json, TermChoice otherwise) {
  TermChoices choices;
  for (const TermInfo& term : kTerms) {
    const std::string choice = json.value(std::string(term.name), "");
    TermChoice& chosen = choices.*term.choice;
    chosen = otherwise;
    if (choice == "on") chosen = TermChoice::on;
    if (choice == "off") chosen = TermChoice::off;
    if (choice == "auto") chosen = TermChoice::automatic;
  }
  return choices;
}

LabelParameters read_label_parameters(const Json& json) {
  return {.occluded_below_visibility = json["occluded_below_visibility"],
          .ignore_below_visibility = json["ignore_below_visibility"],
          .ignore_below_area_px = json["ignore_below_area_px"]};
}

/// Empty: frames are kept without loss.
std::optional<VideoCodecSettings> read_codec(const Json& document) {
  if (!document.contains("output") || !document["output"].contains("codec")) return std::nullopt;
  const Json& codec = document["output"]["codec"];
  return VideoCodecSettings{.name = codec["name"],
                            .bitrate_kbit_s = codec["bitrate_kbit_s"],
                            .bitrate_at_hz = codec.value("bitrate_at_hz", 0.0)};
}

std::chrono::year_month_day date_of(const std::string& text) {
  using namespace std::chrono;
  return {year(std::stoi(text.substr(0, 4))), month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
          day(static_cast<unsigned>(std::stoi(text.substr(8, 2))))};
}

int day_of_year(const std::chrono::year_month_day& date) {
  using namespace std::chrono;
  return static_cast<int>((sys_days(date) - sys_days(date.year() / January / 1)).count()) + 1;
}

double hours_of(const std::string& time) {
  return std::stoi(time.substr(0, 2)) + std::stoi(time.substr(3, 2)) / 60.0;
}

void replace(const Json& weather, const char* key, double& value) {
  if (weather.contains(key)) value = weather[key];
}

/// Air of the day: given by its hours, by its extremes, or by its temperature at `time` and the season's swing.
void read_air(const Json& weather, double solar_h, DayWeather& day) {
  if (weather.contains("air_hourly_k")) day.air_hourly_k = weather["air_hourly_k"].get<std::vector<double>>();
  replace(weather, "air_min_k", day.air_min_k);
  replace(weather, "air_max_k", day.air_max_k);
  if (!weather.contains("air_temperature_k")) return;
  const double warmer_k = weather["air_temperature_k"].get<double>() - air_temperature_k(day, solar_h);
  day.air_min_k += warmer_k;
  day.air_max_k += warmer_k;
}

void read_vapour(const Json& weather, const Air& air, double solar_h, DayWeather& day) {
  if (weather.contains("dew_point_k")) {
    day.vapour_hpa = saturation_hpa(weather["dew_point_k"]);
  } else if (weather.contains("relative_humidity") || weather.contains("air_temperature_k")) {
    day.vapour_hpa = air.relative_humidity * saturation_hpa(air_temperature_k(day, solar_h));
  }
}

/// The weather that a config asks for in a season: the season's, with what `weather` replaces. Its air is that of Table
/// 1's nights, or `air_temperature_k`.
Weather read_weather(const Json& weather, Season season) {
  Weather read = weather_of(season);
  replace(weather, "air_temperature_k", read.air.temperature_k);
  replace(weather, "relative_humidity", read.air.relative_humidity);
  replace(weather, "cloud_fraction", read.air.cloud_fraction);
  replace(weather, "inversion_k", read.air.inversion_k);
  read.inversion_by_balance = !weather.contains("inversion_k");
  if (weather.contains("vehicle_stopped_s")) read.vehicle_stopped_s = weather["vehicle_stopped_s"];
  replace(weather, "cold_pool_k", read.cold_pool_k);
  DayWeather& day = read.day;
  if (weather.contains("date")) day.sun.day_of_year = day_of_year(date_of(weather["date"]));
  if (weather.contains("time")) read.solar_h = hours_of(weather["time"]);
  replace(weather, "latitude_deg", day.sun.latitude_deg);
  replace(weather, "elevation_m", day.elevation_m);
  replace(weather, "wind_m_s", day.night_wind_m_s);
  if (weather.contains("wind_m_s")) day.day_wind_m_s = day.night_wind_m_s + 2;
  replace(weather, "day_wind_m_s", day.day_wind_m_s);
  replace(weather, "rain_days_ago", day.rain_days_ago);
  if (weather.contains("cloud_hourly")) {
    day.cloud_hourly = weather["cloud_hourly"].get<std::vector<double>>();
    read.air.cloud_fraction = cloud_fraction_at(day, read.solar_h);
  }
  day.cloud_fraction = read.air.cloud_fraction;
  read_air(weather, read.solar_h, day);
  read_vapour(weather, read.air, read.solar_h, day);
  return read;
}

/// The schema of the sections alone.
Json section_rules(const Json& schema) {
  Json properties = Json::object();
  for (const char* section : kClipSections) properties[section] = schema["properties"][section];
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
}

std::string in_words(const Json& document, const Json::json_pointer& key) {
  if (!document.contains(key)) return "none";
  const std::string unit = unit_of_key(key.back());
  return brief(document[key]) + (unit.empty() ? "" : " " + unit);
}

void check_once_per_dataset(const Json& own, const Json& dataset, std::vector<std::string>& faults) {
  for (const char* place : kOncePerDataset) {
    const Json::json_pointer key(place);
    if (own.value(key, Json()) == dataset.value(key, Json())) continue;
    faults.push_back(fault(key.parent_pointer().back() + "." + key.back(), in_words(own, key), "",
                           in_words(dataset, key) + ", the dataset's: all clips have the same"));
  }
}

}  // namespace

SharedSettings read_settings(const Json& document, const std::string& where, const Assets& assets) {
  ClipSettings settings;
  const bool physical = document["sensor"]["model"] == "physical";
  settings.camera = read_intrinsics(document["camera"]);
  settings.gives_intrinsics = gives_intrinsics(document["camera"]);
  settings.distortion = distortion_of(document["camera"]["distortion"]);
  settings.sensor = read_sensor(document, where, assets);
  settings.labels = read_label_parameters(document["labels"]);
  if (document.contains("output") && document["output"].contains("link"))
    settings.link = read_link(document["output"]["link"]);
  settings.codec = read_codec(document);
  settings.terms = read_terms(document["terms"], physical ? TermChoice::automatic : TermChoice::off);
  settings.netd_k = settings.sensor.netd_k();
  for (const Season season : {Season::winter, Season::summer})
    settings.weather.at(static_cast<std::size_t>(season)) = read_weather(document["weather"], season);
  return std::make_shared<const ClipSettings>(std::move(settings));
}

void check_weather(const Json& weather, std::initializer_list<Season> seasons,
                   std::vector<std::string>& faults) {
  const auto add = [&faults](const std::string& key, const std::string& value, const char* unit,
                             const std::string& rule) {
    faults.push_back(fault("weather." + key, value, unit, rule));
  };
  if (weather.contains("date") && !date_of(weather["date"]).ok())
    return add("date", fmt::format("\"{}\"", weather["date"].get<std::string>()), "",
               "a day of the calendar");
  const bool extremes = weather.contains("air_min_k") || weather.contains("air_max_k");
  const bool hourly = weather.contains("air_hourly_k");
  if (extremes && hourly)
    return add("air_hourly_k", "24 numbers", "", "none beside weather.air_min_k and weather.air_max_k");
  if (weather.contains("air_temperature_k") && (extremes || hourly))
    return add("air_temperature_k", fmt::format("{}", weather["air_temperature_k"].get<double>()), "K",
               "none beside the air of the whole day");
  if (weather.contains("cloud_hourly") && weather.contains("cloud_fraction"))
    return add("cloud_hourly", "24 numbers", "", "none beside weather.cloud_fraction");
  if (weather.contains("dew_point_k") && weather.contains("relative_humidity"))
    return add("dew_point_k", fmt::format("{}", weather["dew_point_k"].get<double>()), "K",
               "none beside weather.relative_humidity");
  for (const Season season : seasons) {
    const Weather one = read_weather(weather, season);
    try {
      one.day.validate();
    } catch (const ConfigError& error) {
      return faults.emplace_back(error.what()), void();
    }
    const double air_k = air_temperature_k(one.day, one.solar_h);
    if (weather.contains("dew_point_k") && weather["dew_point_k"].get<double>() > air_k)
      return add("dew_point_k", fmt::format("{}", weather["dew_point_k"].get<double>()), "K",
                 fmt::format("at most that of the air at weather.time, {:.2f} K", air_k));
  }
}

Json take_sections(Json& entry) {
  Json own = Json::object();
  if (!entry.is_object()) return own;
  for (const char* section : kClipSections) {
    const auto found = entry.find(section);
    if (found == entry.end()) continue;
    own[section] = std::move(*found);
    entry.erase(found);
  }
  return own;
}

Json difference(const Json& from, const Json& to) {
  Json changes = Json::object();
  for (const auto& [key, value] : from.items()) {
    const auto found = to.find(key);
    if (found == to.end()) {
      changes[key] = nullptr;
    } else if (value.is_object() && found->is_object()) {
      if (Json inner = difference(value, *found); !inner.empty()) changes[key] = std::move(inner);
    } else if (value != *found) {
      changes[key] = *found;
    }
  }
  std::map<std::string, Json> added;
  for (const auto& [key, value] : to.items())
    if (!from.contains(key)) added[key] = value;
  for (auto& [key, value] : added) changes[key] = std::move(value);
  return changes;
}

const SectionResolver::Own& SectionResolver::of(const Json& sections, Season season,
                                                const std::string& place) {
  const std::string key = std::string(season_name(season)) + sections.dump();
  const auto found = known_.find(key);
  return found != known_.end() ? found->second
                               : known_.emplace(key, resolve(sections, season, place)).first->second;
}

SectionResolver::Own SectionResolver::resolve(const Json& sections, Season season,
                                              const std::string& place) const {
  if (sections.empty()) return {.changes = Json::object(), .settings = settings_};
  const std::string where = fmt::format("{}: {}.", name_, place);
  std::vector<std::string> faults;
  const auto throw_if_any = [&] {
    for (std::string& one : faults) one.insert(0, place + ".");
    throw_faults(faults, name_);
  };
  Json own = Json::object();
  Json dataset = Json::object();
  for (const char* section : kClipSections) {
    if (given_.contains(section)) own[section] = given_[section];
    if (resolved_.contains(section)) dataset[section] = resolved_[section];
  }
  own.merge_patch(sections);
  apply_preset(own, schema_, where, assets_);
  faults = check_and_fill(own, section_rules(schema_));
  throw_if_any();
  apply_lens(own, schema_, faults);
  throw_if_any();
  check_once_per_dataset(own, dataset, faults);
  check_weather(own["weather"], {season}, faults);
  throw_if_any();
  SharedSettings settings = read_settings(own, where, assets_);
  check_intrinsics(settings->camera, faults);
  throw_if_any();
  return {.changes = difference(dataset, own), .settings = std::move(settings)};
}

}  // namespace thermal
