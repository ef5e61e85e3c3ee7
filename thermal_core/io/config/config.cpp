#include "io/config/config.h"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/assets.h"
#include "io/config/draws.h"
#include "io/config/lens.h"
#include "io/config/sensor.h"
#include "io/config/weather.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

Season season_in(const Json& entry) { return season_of(entry["season"].get<std::string>()); }

/// Null: none of its own.
SharedSettings own_of(const std::map<std::string, SharedSettings>& all, const std::string& id) {
  const auto found = all.find(id);
  return found == all.end() ? nullptr : found->second;
}

ClipConfig read_clip(const Json& json, const Config& config) {
  ClipConfig clip = {.id = json["id"],
                     .season = season_in(json),
                     .frames = json["frames"],
                     .frame_rate_hz = json["frame_rate_hz"],
                     .start_s = json["start_s"]};
  clip.own = own_of(config.own_of_clips, clip.id);
  if (!clip.own && json.contains("of_flight")) clip.own = own_of(config.own_of_flights, json["of_flight"]);
  return clip;
}

/// One fault for each entry as the config lists them.
void check_ids(const std::vector<std::string>& ids, const std::vector<std::string>& places,
               std::vector<std::string>& faults) {
  std::set<std::string> seen;
  std::set<std::string> at_fault;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (seen.insert(ids[i]).second || !at_fault.insert(places[i]).second) continue;
    faults.push_back(fault(places[i] + ".id", fmt::format("\"{}\"", ids[i]), "", "each id once"));
  }
}

/// Checks that there is something to make, and that ids are unique.
void check_flown(const std::vector<std::string>& flights, const std::vector<ClipConfig>& clips,
                 EntryNames& places, std::vector<std::string>& faults) {
  if (clips.empty() && flights.empty())
    faults.emplace_back("clips and flights are empty; expected at least one of either");
  std::vector<std::string> ids;
  for (const ClipConfig& clip : clips) ids.push_back(clip.id);
  check_ids(ids, places["clips"], faults);
  check_ids(flights, places["flights"], faults);
}

/// One step of a setting's key: "clips[0]" is the member "clips", then entry 0.
Json& step_into(Json& at, const std::string& part, const std::string& assignment) {
  const std::size_t bracket = part.find('[');
  const std::string member = part.substr(0, bracket);
  if (at.is_array()) {
    throw ConfigError(fault("--set", fmt::format("\"{}\"", assignment), "",
                            "an entry of a list in brackets, such as clips[0].frames=8"));
  }
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

/// Makes the path of a file that a document names relative to `folder` absolute, if it names one.
void root_file(Json& document, const char* place, const Path& folder) {
  const Json::json_pointer file(place);
  if (!document.contains(file) || !document[file].is_string()) return;  // the schema reports it
  document[file] = (folder / document[file].get<std::string>()).string();
}

/// The same in the flight of a clip or a long flight, or in each of a choice of flights.
void root_in_flight(Json& entry, const char* place, const Path& folder) {
  if (!entry.is_object() || !entry.contains("flight")) return;
  Json& flight = entry["flight"];
  root_file(flight, place, folder);
  if (!flight.is_object() || !flight.contains("choice") || !flight["choice"].is_array()) return;
  for (Json& one : flight["choice"]) root_file(one, place, folder);
}

/// Anything that is not JSON is a string; the schema reports it if it is wrong.
Json parse_value(const std::string& text) {
  try {
    return parse_json(text, "--set");
  } catch (const ConfigError&) {
    return Json(text);
  }
}

/// Puts the sections of a list's entries back, resolved. Returns the settings of those that have their own, by id.
std::map<std::string, SharedSettings> put_back_sections(const Json& own,
                                                        const std::vector<std::string>& places,
                                                        SectionResolver& sections, Json& entries) {
  std::map<std::string, SharedSettings> settings;
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (own[k].empty()) continue;
    const SectionResolver::Own& found = sections.of(own[k], season_in(entries[k]), places[k]);
    entries[k].update(found.changes);
    settings[entries[k]["id"]] = found.settings;
  }
  return settings;
}

/// Of the dataset, and of the clips and flights that have settings of their own.
std::vector<Lens> lenses_of(const Config& config) {
  std::vector<Lens> lenses = {{config.camera, config.distortion}};
  for (const auto* own : {&config.own_of_clips, &config.own_of_flights})
    for (const auto& [id, settings] : *own) lenses.push_back({settings->camera, settings->distortion});
  return lenses;
}

/// Puts an engine in the place of `auto`: the ray caster, which draws all but passes that extend beyond the picture.
/// Returns why, empty if there was an engine.
std::string choose_engine(Json& render) {
  if (render["engine"] != "auto") return "";
  const Json overscan_px = render.value("overscan_px", Json(0));
  render["engine"] = overscan_px == 0 ? "embree" : "blender";
  if (overscan_px == 0) return "the ray caster, which draws all of this config";
  return fmt::format("because of render.overscan_px = {} px: embree draws nothing beyond the picture",
                     overscan_px.dump());
}

/// A real camera's pixels average what they see: 4 x 4 samples, with the engine `embree` only where they differ. The
/// published model has one sample a pixel.
void fill_sampling(Json& render, bool physical) {
  if (!render.contains("supersample")) render["supersample"] = physical ? 4 : 1;
  const bool by_default = physical && render["engine"] == "embree" && render["supersample"] > 1;
  if (!render.contains("sampling")) render["sampling"] = by_default ? "adaptive" : "full";
}

/// As the config has it; Table 1's line says nothing of an inversion.
Weather given_weather(const Config& config, const ClipConfig& clip) {
  Weather weather = settings_of(config, clip).weather.at(static_cast<std::size_t>(clip.season));
  weather.inversion_by_balance = weather.inversion_by_balance && config.heat_balance;
  return weather;
}

}  // namespace

const ClipConfig& Config::clip(const std::string& id, const std::string& where) const {
  const auto found = std::ranges::find(clips, id, &ClipConfig::id);
  if (found != clips.end()) return *found;
  std::vector<std::string> known;
  for (const ClipConfig& clip : clips) known.push_back(clip.id);
  throw ConfigError(fault(where, fmt::format("\"{}\"", id), "", "one of " + list_names(known)) +
                    did_you_mean(id, known));
}

const ClipSettings& settings_of(const Config& config, const ClipConfig& clip) {
  return clip.own ? *clip.own : config;
}

Weather weather_of(const Config& config, const ClipConfig& clip) {
  Weather weather = given_weather(config, clip);
  if (!config.heat_balance) return weather;
  return at_moment(weather, clip.start_s + 0.5 * (clip.frames - 1) / clip.frame_rate_hz);
}

Weather weather_at_start(const Config& config, const ClipConfig& clip) {
  const Weather weather = given_weather(config, clip);
  return config.heat_balance ? at_moment(weather, 0) : weather;
}

std::vector<FlownWeather> flown_weather(const Config& config) {
  std::vector<FlownWeather> flown;
  const auto add = [&](Season season, const SharedSettings& own, double start_s, double duration_s) {
    const Weather& weather = (own ? *own : config).weather.at(static_cast<std::size_t>(season));
    auto found = std::ranges::find_if(
        flown, [&](const FlownWeather& one) { return one.season == season && one.weather == weather; });
    if (found == flown.end())
      found = flown.insert(found, {.season = season, .weather = weather, .hours = {}});
    const double start_h = weather.solar_h + start_s / 3600;
    found->hours.emplace_back(start_h, start_h + duration_s / 3600);
  };
  for (const ClipConfig& clip : config.clips)
    add(clip.season, clip.own, clip.start_s, clip.frames / clip.frame_rate_hz);
  for (const Json& flight : config.resolved["flights"]) {
    add(season_in(flight), own_of(config.own_of_flights, flight["id"]), flight.value("start_s", 0.0),
        flight.value("duration_s", 0.0));
  }
  std::ranges::stable_sort(flown, {}, &FlownWeather::season);
  return flown;
}

void set_season(Json& document, const Json& season) {
  for (const char* flown : {"clips", "flights"}) {
    if (!document.contains(flown)) continue;
    for (Json& one : document[flown]) {
      if (one.is_object()) one["season"] = season;  // the schema reports entries of other types
    }
  }
}

void apply_setting(Json& document, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError(fault("--set", fmt::format("\"{}\"", assignment), "", "KEY=VALUE"));
  }
  const std::string key = assignment.substr(0, equals);
  const Json value = parse_value(assignment.substr(equals + 1));
  if (key == "season") return set_season(document, value);
  Json* at = &document;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t dot = std::min(key.find('.', begin), key.size());
    at = &step_into(*at, key.substr(begin, dot - begin), assignment);
    begin = dot + 1;
  }
  *at = value;
}

void root_files(Json& document, const Path& folder) {
  root_resolved_files(document, folder);
  root_file(document, "/scene/terrain/heightmap/file", folder);
  root_file(document, "/scene/terrain/density_map/file", folder);
  for (const char* flown : {"clips", "flights"}) {
    if (!document.contains(flown)) continue;
    for (Json& one : document[flown]) root_in_flight(one, "/waypoints/file", folder);
  }
}

void root_resolved_files(Json& document, const Path& folder) {
  root_file(document, "/camera/calibration", folder);
  for (const char* flown : {"clips", "flights"}) {
    if (!document.contains(flown)) continue;
    for (Json& one : document[flown]) {
      root_file(one, "/camera/calibration", folder);
      root_in_flight(one, "/views/file", folder);
    }
  }
}

Json cut_from(const Json& flight, Json clip) {
  clip["of_flight"] = flight.at("id");
  for (const char* shared : {"season", "flight", "drawn"})
    if (flight.contains(shared)) clip[shared] = flight[shared];
  for (const char* section : kClipSections)
    if (flight.contains(section)) clip[section] = flight[section];
  return clip;
}

Config with_clips(Config config, const Json& clips) {
  for (const Json& clip : clips) {
    config.clips.push_back(read_clip(clip, config));
    config.resolved["clips"].push_back(clip);
  }
  config.flights.clear();
  config.resolved["flights"] = Json::array();
  return config;
}

Config resolve_config(Json document, const std::string& name, const Assets& assets) {
  const Json schema = assets.schema("config");
  DrawnConfig drawn = draw_config(std::move(document), schema, name);
  document = std::move(drawn.document);
  apply_preset(document, schema, name + ": ", assets);
  std::vector<std::string> faults = check_and_fill(document, schema, "", drawn.places);
  throw_faults(faults, name);
  apply_lens(document, schema, faults);
  throw_faults(faults, name);
  check_weather(document["weather"], {Season::winter, Season::summer}, faults);
  throw_faults(faults, name);
  Config config;
  static_cast<ClipSettings&>(config) = read_settings(document, name + ": ", assets);
  config.name = document["name"];
  config.seed = document["seed"];
  config.width_px = document["camera"]["width_px"];
  config.height_px = document["camera"]["height_px"];
  config.physical = document["sensor"]["model"] == "physical";
  if (!document["scene"].contains("temperatures"))
    document["scene"]["temperatures"] = config.physical ? "heat_balance" : "table_1";
  config.heat_balance = document["scene"]["temperatures"] == "heat_balance";
  SectionResolver sections(drawn.given, document, schema, name, assets);
  config.own_of_clips =
      put_back_sections(drawn.own_clips, drawn.places["clips"], sections, document["clips"]);
  config.own_of_flights =
      put_back_sections(drawn.own_flights, drawn.places["flights"], sections, document["flights"]);
  for (const Json& clip : document["clips"]) config.clips.push_back(read_clip(clip, config));
  for (const Json& flight : document["flights"]) config.flights.push_back(flight["id"]);
  check_flown(config.flights, config.clips, drawn.places, faults);
  check_intrinsics(config.camera, faults);
  config.engine_reason = choose_engine(document["render"]);
  fill_sampling(document["render"], config.physical);
  const Json& render = document["render"];
  if (render["sampling"] == "adaptive" && render["engine"] != "embree")
    faults.emplace_back("render.sampling = \"adaptive\"; expected \"full\", or render.engine = \"embree\"");
  throw_faults(faults, name);
  const int needed_px = fill_overscan(document, lenses_of(config), faults);
  throw_faults(faults, name);
  config.overscan_px = document["render"]["overscan_px"];
  config.view_margin_px = std::max(config.overscan_px, needed_px);
  config.supersample = document["render"]["supersample"];
  config.actor_layer = document["render"]["actor_layer"];
  config.poses_all = document["render"]["posed_actors"] == "all";
  config.engine = document["render"]["engine"] == "embree" ? Engine::embree : Engine::blender;
  config.adaptive_sampling = document["render"]["sampling"] == "adaptive";
  document.erase("$schema");
  config.resolved = std::move(document);
  return config;
}

std::string expected_config(const Json& here, const Json& there) {
  const Json::json_pointer engine("/render/engine");
  if (!here.contains(engine) || !there.contains(engine) || here[engine] == there[engine] ||
      !there[engine].is_string())
    return "the same config";
  return "the same config with --set render.engine=" + there[engine].get<std::string>();
}

}  // namespace thermal
