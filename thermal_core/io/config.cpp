#include "io/config.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/json_schema.h"
#include "io/lens_config.h"
#include "io/sensor_config.h"

namespace thermal {
namespace {

/// `otherwise` is the model's choice for terms the config says nothing of.
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

std::optional<double> read_optional(const Json& json, const char* key) {
  return json.contains(key) ? std::optional<double>(json[key].get<double>()) : std::nullopt;
}

ClipConfig read_clip(const Json& json) {
  return {.id = json["id"],
          .season = json["season"] == "summer" ? Season::summer : Season::winter,
          .frames = json["frames"],
          .frame_rate_hz = json["frame_rate_hz"]};
}

void check_ids(const std::vector<ClipConfig>& clips, std::vector<std::string>& faults) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (seen.insert(clips[i].id).second) continue;
    faults.push_back(
        fault(fmt::format("clips[{}].id", i), fmt::format("\"{}\"", clips[i].id), "", "each id once"));
  }
}

void throw_faults(const std::vector<std::string>& faults, const std::string& name) {
  if (faults.empty()) return;
  std::vector<std::string> lines;
  for (const std::string& line : faults) lines.push_back(name + ": " + line);
  throw ConfigError(fmt::format("{}", fmt::join(lines, "\n")));
}

/// One step of a setting's key: "clips[0]" is the member "clips", then entry 0.
Json& step_into(Json& at, const std::string& part, const std::string& assignment) {
  const std::size_t bracket = part.find('[');
  const std::string member = part.substr(0, bracket);
  if (member.empty() || !(at.is_object() || at.is_null())) {
    throw ConfigError(
        fault("--set", fmt::format("\"{}\"", assignment), "", "KEY=VALUE with the key of an object"));
  }
  Json& value = at[member];
  if (bracket == std::string::npos) return value;
  std::size_t entry = 0;
  const char* begin = part.data() + bracket + 1;
  const auto [end, error] = std::from_chars(begin, part.data() + part.size(), entry);
  const bool whole = error == std::errc() && end != begin && std::string_view(end) == "]";
  if (!whole || !value.is_array() || entry >= value.size()) {
    throw ConfigError(fault("--set", fmt::format("\"{}\"", assignment), "",
                            fmt::format("an entry of {}, [0] to [{}]", member,
                                        value.is_array() && !value.empty() ? value.size() - 1 : 0)));
  }
  return value[entry];
}

Json parse_value(const std::string& text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

}  // namespace

const ClipConfig& Config::clip(const std::string& id, const std::string& where) const {
  std::vector<std::string> known;
  for (const ClipConfig& clip : clips) {
    if (clip.id == id) return clip;
    known.push_back(clip.id);
  }
  throw ConfigError(fault(where, fmt::format("\"{}\"", id), "", "one of " + list_names(known)) +
                    did_you_mean(id, known));
}

Weather weather_of(const Config& config, Season season) {
  Weather weather = weather_of(season);
  weather.air.temperature_k = config.air_temperature_k.value_or(weather.air.temperature_k);
  weather.air.relative_humidity = config.relative_humidity.value_or(weather.air.relative_humidity);
  weather.air.cloud_fraction = config.cloud_fraction.value_or(weather.air.cloud_fraction);
  weather.vehicle_stopped_s = config.vehicle_stopped_s;
  return weather;
}

void apply_setting(Json& document, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError(fault("--set", fmt::format("\"{}\"", assignment), "", "KEY=VALUE"));
  }
  const std::string key = assignment.substr(0, equals);
  const Json value = parse_value(assignment.substr(equals + 1));
  if (key == "season") {
    for (Json& clip : document["clips"]) clip["season"] = value;
    return;
  }
  Json* at = &document;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t dot = std::min(key.find('.', begin), key.size());
    at = &step_into(*at, key.substr(begin, dot - begin), assignment);
    begin = dot + 1;
  }
  *at = value;
}

void root_files(Json& document, const Path& folder) {
  for (const char* map : {"heightmap", "density_map"}) {
    const Json::json_pointer place("/scene/terrain/" + std::string(map) + "/file");
    if (!document.contains(place) || !document[place].is_string()) continue;  // the schema will tell
    document[place] = (folder / document[place].get<std::string>()).string();
  }
}

Config resolve_config(Json document, const std::string& name, const Path& home) {
  const Json schema = read_json(home / "configs" / "schema" / "config.schema.json");
  apply_preset(document, schema, name, home);
  std::vector<std::string> faults = check_and_fill(document, schema);
  throw_faults(faults, name);
  Config config;
  config.name = document["name"];
  config.seed = document["seed"];
  config.width_px = document["camera"]["width_px"];
  config.height_px = document["camera"]["height_px"];
  config.distortion = read_distortion(document["camera"]["distortion"]);
  config.sensor = read_sensor(document, name, home);
  config.physical = document["sensor"]["model"] == "physical";
  config.terms = read_terms(document["terms"], config.physical ? TermChoice::automatic : TermChoice::off);
  config.netd_k = config.sensor.netd_k();
  config.air_temperature_k = read_optional(document["weather"], "air_temperature_k");
  config.relative_humidity = read_optional(document["weather"], "relative_humidity");
  config.cloud_fraction = read_optional(document["weather"], "cloud_fraction");
  config.vehicle_stopped_s = document["weather"]["vehicle_stopped_s"];
  for (const Json& clip : document["clips"]) config.clips.push_back(read_clip(clip));
  check_ids(config.clips, faults);
  fill_overscan(document, faults);
  throw_faults(faults, name);
  config.overscan_px = document["render"]["overscan_px"];
  document.erase("$schema");
  config.resolved = std::move(document);
  return config;
}

}  // namespace thermal
