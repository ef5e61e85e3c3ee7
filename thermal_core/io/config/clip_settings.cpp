#include "io/config/clip_settings.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/config/lens.h"
#include "io/config/sensor.h"
#include "io/config/weather.h"
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

ClipSettings read_settings(const Json& document, const std::string& where, const Assets& assets) {
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
  return settings;
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
  if (sections.empty()) return {.changes = Json::object()};
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
  auto settings = std::make_shared<ClipSettings>(read_settings(own, where, assets_));
  check_intrinsics(settings->camera, faults);
  throw_if_any();
  return {.changes = difference(dataset, own), .settings = std::move(settings)};
}

}  // namespace thermal
