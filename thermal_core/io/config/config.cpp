#include "io/config/config.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/assets.h"
#include "io/config/draws.h"
#include "io/config/lens.h"
#include "io/config/sections.h"
#include "io/config/sensor.h"

namespace thermal {
namespace {

Season season_in(const Json& entry) { return season_of(entry["season"].get<std::string>()); }

/// Of a clip or a flight; clips whose passes exist may have none.
double speed_m_s_in(const Json& entry) {
  return entry.value(Json::json_pointer("/flight/speed_m_s"), ClipSpec().speed_m_s);
}

ClipSpec read_clip(const Json& json, SharedSettings settings) {
  return {.id = json["id"],
          .season = season_in(json),
          .frames = json["frames"],
          .frame_rate_hz = json["frame_rate_hz"],
          .start_s = json["start_s"],
          .of_flight = json.value("of_flight", ""),
          .speed_m_s = speed_m_s_in(json),
          .settings = std::move(settings)};
}

FlightSpec read_flight(const Json& json, SharedSettings settings) {
  return {.id = json["id"],
          .season = season_in(json),
          .start_s = json.value("start_s", 0.0),
          .duration_s = json.value("duration_s", 0.0),
          .speed_m_s = speed_m_s_in(json),
          .settings = std::move(settings)};
}

/// Puts the sections of a list's entries back, resolved, and reads the entries with what they mean. Of ids that are not
/// unique, one fault for each entry as the config lists them.
template <typename Spec>
std::vector<Spec> read_entries(const Json& own, const std::vector<std::string>& places,
                               SectionResolver& sections, Json& entries,
                               Spec (*read)(const Json& entry, SharedSettings settings),
                               std::vector<std::string>& faults) {
  std::vector<Spec> specs;
  std::set<std::string> seen;
  std::set<std::string> at_fault;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const SectionResolver::Own& found = sections.of(own[k], season_in(entries[k]), places[k]);
    entries[k].update(found.changes);
    const Spec& spec = specs.emplace_back(read(entries[k], found.settings));
    if (!seen.insert(spec.id).second && at_fault.insert(places[k]).second)
      faults.push_back(fault(places[k] + ".id", fmt::format("\"{}\"", spec.id), "", "each id once"));
  }
  return specs;
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

/// Calls `act` with the clips and flights of a document.
void for_each_flown(Json& document, const std::function<void(Json& one)>& act) {
  for (const char* flown : {"clips", "flights"})
    if (document.contains(flown))
      for (Json& one : document[flown]) act(one);
}

/// Anything that is not JSON is a string; the schema reports it if it is wrong.
Json parse_value(const std::string& text) {
  try {
    return parse_json(text, "--set");
  } catch (const ConfigError&) {
    return Json(text);
  }
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

/// A clip that is cut from a flight, as a document has it.
Json document_of(const ClipSpec& clip, const Json& flight) {
  Json document = {{"id", clip.id},
                   {"start_s", clip.start_s},
                   {"frames", clip.frames},
                   {"frame_rate_hz", clip.frame_rate_hz},
                   {"of_flight", clip.of_flight}};
  for (const char* shared : {"season", "flight", "drawn"})
    if (flight.contains(shared)) document[shared] = flight[shared];
  for (const char* section : kClipSections)
    if (flight.contains(section)) document[section] = flight[section];
  return document;
}

/// The entries of a list by their ids.
std::map<std::string, Json> by_id(Json entries) {
  std::map<std::string, Json> found;
  for (Json& entry : entries) {
    const std::string id = entry["id"];
    found[id] = std::move(entry);
  }
  return found;
}

}  // namespace

void set_season(Json& document, const Json& season) {
  for_each_flown(document, [&](Json& one) {
    if (one.is_object()) one["season"] = season;  // the schema reports entries of other types
  });
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
  for_each_flown(document, [&](Json& one) { root_in_flight(one, "/waypoints/file", folder); });
}

void root_resolved_files(Json& document, const Path& folder) {
  root_file(document, "/camera/calibration", folder);
  for_each_flown(document, [&](Json& one) {
    root_file(one, "/camera/calibration", folder);
    root_in_flight(one, "/views/file", folder);
  });
}

ResolvedConfig with_clips(ResolvedConfig config, std::vector<ClipSpec> clips) {
  std::map<std::string, Json> own = by_id(std::exchange(config.document["clips"], Json::array()));
  const std::map<std::string, Json> flights = by_id(std::exchange(config.document["flights"], Json::array()));
  for (const ClipSpec& clip : clips) {
    const auto found = own.find(clip.id);
    config.document["clips"].push_back(found != own.end() ? std::move(found->second)
                                                          : document_of(clip, flights.at(clip.of_flight)));
  }
  config.spec.clips = std::move(clips);
  config.spec.flights.clear();
  config.entries.clear();
  return config;
}

ResolvedConfig resolve_config(Json document, const std::string& name, const Assets& assets) {
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
  DatasetSpec spec = {.name = document["name"],
                      .seed = document["seed"],
                      .settings = read_settings(document, name + ": ", assets),
                      .width_px = document["camera"]["width_px"],
                      .height_px = document["camera"]["height_px"],
                      .physical = document["sensor"]["model"] == "physical"};
  if (!document["scene"].contains("temperatures"))
    document["scene"]["temperatures"] = spec.physical ? "heat_balance" : "table_1";
  spec.heat_balance = document["scene"]["temperatures"] == "heat_balance";
  SectionResolver sections(drawn.given, document, spec.settings, schema, name, assets);
  const auto read_list = [&](const char* list, const Json& own, auto read) {
    return read_entries(own, drawn.places[list], sections, document[list], read, faults);
  };
  spec.clips = read_list("clips", drawn.own_clips, read_clip);
  spec.flights = read_list("flights", drawn.own_flights, read_flight);
  if (spec.clips.empty() && spec.flights.empty())
    faults.emplace_back("clips and flights are empty; expected at least one of either");
  check_intrinsics(spec.settings->camera, faults);
  Json& render = document["render"];
  spec.engine_reason = choose_engine(render);
  fill_sampling(render, spec.physical);
  if (render["sampling"] == "adaptive" && render["engine"] != "embree")
    faults.emplace_back("render.sampling = \"adaptive\"; expected \"full\", or render.engine = \"embree\"");
  throw_faults(faults, name);
  const int needed_px = fill_overscan(document, spec, faults);
  throw_faults(faults, name);
  spec.overscan_px = render["overscan_px"];
  spec.view_margin_px = std::max(spec.overscan_px, needed_px);
  spec.supersample = render["supersample"];
  spec.actor_layer = render["actor_layer"];
  spec.poses_all = render["posed_actors"] == "all";
  spec.engine = render["engine"] == "embree" ? Engine::embree : Engine::blender;
  spec.adaptive_sampling = render["sampling"] == "adaptive";
  document.erase("$schema");
  return {.document = std::move(document), .spec = std::move(spec), .entries = std::move(drawn.places)};
}

std::string expected_config(const Json& here, const Json& there) {
  const Json::json_pointer engine("/render/engine");
  if (!here.contains(engine) || !there.contains(engine) || here[engine] == there[engine] ||
      !there[engine].is_string())
    return "the same config";
  return "the same config with --set render.engine=" + there[engine].get<std::string>();
}

}  // namespace thermal
