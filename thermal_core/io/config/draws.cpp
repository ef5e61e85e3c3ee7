#include "io/config/draws.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/config/distribution.h"
#include "io/config/sections.h"
#include "io/config/views_file.h"

namespace thermal {
namespace {

/// Of a list, which is taken as a whole.
bool has_distribution_in_list(const Json& value, const Json& rules) {
  if (!value.is_array()) return false;
  const Json& its_rules = rules_for_items(rules);
  for (const Json& entry : value)
    if (is_distribution(entry, its_rules) || has_distribution_in_list(entry, its_rules)) return true;
  return false;
}

}  // namespace

Json take_distributions(Json& value, const Json& rules) {
  Json taken = Json::object();
  if (!value.is_object()) return taken;
  std::vector<std::string> emptied;
  for (const auto& [name, member] : value.items()) {
    const Json& its_rules = rules_for(rules, name);
    if (is_distribution(member, its_rules) || has_distribution_in_list(member, its_rules)) {
      taken[name] = std::move(member);
      emptied.push_back(name);
    } else if (Json inner = take_distributions(member, its_rules); !inner.empty()) {
      taken[name] = std::move(inner);
    }
  }
  for (const std::string& name : emptied) value.erase(name);
  return taken;
}

void overlay(Json& into, const Json& changes) {
  if (!into.is_object() || !changes.is_object()) {
    into = changes;
    return;
  }
  for (const auto& [key, value] : changes.items()) overlay(into[key], value);
}

namespace {

constexpr std::size_t kMostEntries = 100'000;  // of clips in the schema

std::uint32_t seed_of(const Json& document) {
  const auto found = document.find("seed");
  if (found == document.end() || !found->is_number()) return 1;
  const auto seed = found->get<double>();
  const bool fits = seed >= 0 && seed <= std::numeric_limits<std::uint32_t>::max();
  return fits ? static_cast<std::uint32_t>(seed) : 1;  // the schema reports others
}

Json::json_pointer pointer_to(const std::string& path) {
  Json::json_pointer pointer;
  for (const std::string_view key : split(path, '.')) pointer.push_back(std::string(key));
  return pointer;
}

/// Draws the values of one clip or flight, or of the dataset.
class Drawer {
 public:
  Drawer(std::uint32_t seed, std::string owner, std::string place)
      : seed_(seed), owner_(std::move(owner)), place_(std::move(place)) {}

  /// `path` is that of the value, "" for the whole entry.
  void draw(Json& value, const Json& rules, const std::string& path) {
    const std::string where = place_ + (place_.empty() || path.empty() ? "" : ".") + path;
    for (std::string& one : draw_within(value, rules, key_of(path), where, faults_))
      drawn_.insert(std::move(one));
  }

  /// Removes the keys for which nothing, null, was drawn. Sections keep them, to remove what the dataset has.
  void remove_nothing(Json& container) const {
    for (const std::string& path : drawn_) {
      const Json::json_pointer key = pointer_to(path);
      if (container.contains(key) && container[key].is_null())
        container[key.parent_pointer()].erase(key.back());
    }
  }

  [[nodiscard]] DrawKey key_of(const std::string& path) const { return {seed_, owner_, path}; }
  void forget(const std::string& path) { drawn_.erase(path); }
  void remember(const std::string& path) { drawn_.insert(path); }
  [[nodiscard]] const std::set<std::string>& drawn() const { return drawn_; }
  [[nodiscard]] const std::string& place() const { return place_; }
  [[nodiscard]] std::vector<std::string>& faults() { return faults_; }

  /// Lists what was drawn.
  void record(Json& entry) const {
    if (!drawn_.empty()) entry["drawn"] = drawn_;
  }

 private:
  std::uint32_t seed_;
  std::string owner_;
  std::string place_;
  std::set<std::string> drawn_;
  std::vector<std::string> faults_;
};

/// The document's rules for an entry of a list, without its sections.
Json rules_of_entries(const Json& schema, const char* list) {
  Json rules = schema["properties"][list]["items"];
  rules["properties"]["flight"] = schema["$defs"]["flight"];
  for (const char* section : kClipSections) rules["properties"].erase(section);
  return rules;
}

class Draws {
 public:
  Draws(Json document, const Json& schema, const std::string& name)
      : schema_(schema), name_(name), seed_(seed_of(document)) {
    found_.document = std::move(document);
  }

  DrawnConfig draw() && {
    draw_dataset();
    found_.own_clips = draw_entries("clips");
    found_.own_flights = draw_entries("flights");
    return std::move(found_);
  }

 private:
  [[nodiscard]] const Json& rules_of(const std::string& section) const {
    return schema_["properties"][section];
  }

  /// The scene and what all clips share keep one draw. For the rest of the sections, the dataset has a draw too, which
  /// stands for clips that are not in the config.
  void draw_dataset() {
    Json& document = found_.document;
    Drawer drawer(seed_, "", "");
    if (document.contains("scene")) drawer.draw(document["scene"], rules_of("scene"), "scene");
    drawer.remove_nothing(document);
    draw_shared(drawer);
    throw_faults(drawer.faults(), name_);
    random_ = Json::object();
    for (const char* section : kClipSections) {
      if (!document.contains(section)) continue;
      Json outer = {{section, document[section]}};
      random_.update(take_distributions(outer, schema_));
      if (outer.contains(section)) {
        document[section] = std::move(outer[section]);
      } else {
        document.erase(section);
      }
    }
    for (const char* section : kClipSections)
      if (document.contains(section)) found_.given[section] = document[section];
    Json own = random_;
    drawer.draw(own, schema_, "");
    throw_faults(drawer.faults(), name_);
    document.merge_patch(own);
    drawer.record(document);
  }

  void draw_shared(Drawer& drawer) {
    for (const char* place : kOncePerDataset) {
      const Json::json_pointer key(place);
      const std::string section = key.parent_pointer().back();
      if (!found_.document.contains(key)) continue;
      const Json& rules = rules_of(section)["properties"][key.back()];
      drawer.draw(found_.document[key], rules, section + "." + key.back());
    }
  }

  /// Returns the entries' own sections.
  Json draw_entries(const char* list) {
    Json own = Json::array();
    Json& document = found_.document;
    if (!document.contains(list) || !document[list].is_array()) return own;
    Json& entries = document[list];
    entries = repeated(std::move(entries), list);
    const Json rules = rules_of_entries(schema_, list);
    for (std::size_t k = 0; k < entries.size(); ++k)
      own.push_back(draw_entry(entries[k], rules, found_.places[list][k]));
    return own;
  }

  /// Entries with a count as that many entries.
  Json repeated(Json entries, const char* list) {
    std::vector<std::string>& places = found_.places[list];
    Json all = Json::array();
    for (std::size_t k = 0; k < entries.size(); ++k) {
      std::string place = fmt::format("{}[{}]", list, k);
      Json& entry = entries[k];
      const std::size_t count = take_count(entry, place);
      if (all.size() + count > kMostEntries)
        throw_faults({fault(place + ".count", std::to_string(count), "",
                            fmt::format("at most {} clips in all", kMostEntries))},
                     name_);
      if (is_counted_) place += fmt::format(" ({}, {})", entry["id"].dump(), in_words(count, list));
      for (std::size_t n = 0; n < count; ++n) {
        Json one = entry;
        if (is_counted_) one["id"] = fmt::format("{}_{:04}", entry["id"].get<std::string>(), n);
        all.push_back(std::move(one));
        places.push_back(place);
      }
    }
    return all;
  }

  /// "20 clips", "1 flight".
  static std::string in_words(std::size_t count, std::string_view list) {
    return fmt::format("{} {}", count, count == 1 ? list.substr(0, list.size() - 1) : list);
  }

  /// Sets is_counted_. What the schema rejects stays there.
  std::size_t take_count(Json& entry, const std::string& place) {
    is_counted_ =
        entry.is_object() && entry.contains("count") && entry.contains("id") && entry["id"].is_string();
    if (!is_counted_) return 1;
    Json count = std::move(entry["count"]);
    const Json& rules = schema_["properties"]["clips"]["items"]["properties"];
    std::vector<std::string> faults = check_and_fill(entry["id"], rules["id"], place + ".id");
    for (std::string& one : check_and_fill(count, rules["count"], place + ".count"))
      faults.push_back(std::move(one));
    throw_faults(faults, name_);
    entry.erase("count");
    return count.get<std::size_t>();
  }

  Json draw_entry(Json& entry, const Json& rules, const std::string& place) {
    Json own = take_sections(entry);
    if (!entry.is_object() || !entry.contains("id") || !entry["id"].is_string()) return own;
    Drawer drawer(seed_, entry["id"], place);
    if (!entry.contains("of_flight")) draw_sections(own, drawer);
    drawer.draw(entry, rules, "");
    drawer.remove_nothing(entry);
    draw_view(entry, rules, drawer);
    throw_faults(drawer.faults(), name_);
    drawer.record(entry);
    return own;
  }

  /// What the dataset leaves to each clip, below what the clip itself has.
  void draw_sections(Json& own, Drawer& drawer) const {
    Json sections = random_;
    drawer.draw(sections, schema_, "");
    const std::set<std::string> inherited = drawer.drawn();
    for (const std::string& path : inherited)
      if (own.contains(pointer_to(path))) drawer.forget(path);
    drawer.draw(own, schema_, "");
    overlay(sections, own);
    own = std::move(sections);
  }

  /// A row of the flight's file of views, as its altitude_m, look_angle_deg and perhaps speed_m_s.
  void draw_view(Json& entry, const Json& rules, Drawer& drawer) {
    const Json::json_pointer place("/flight/views/file");
    if (!entry.contains(place) || !entry[place].is_string()) return;
    const Json& keys = rules["properties"]["flight"]["properties"];
    const Path file = entry[place].get<std::string>();
    const auto [known, is_new] = views_.try_emplace(file);
    try {
      if (is_new) known->second = read_views(file, keys);
    } catch (const Error& error) {
      throw ConfigError(fmt::format("{}: {}.flight.views: {}", name_, drawer.place(), error.what()));
    }
    Json& flight = entry["flight"];
    std::vector<double> weights;
    for (const View& view : known->second) weights.push_back(view.weight);
    const std::size_t row = weighted_place(weights, uniform_draw(drawer.key_of("flight.views")));
    for (const auto& [key, value] : known->second[row].values) {
      if (flight.contains(key))
        drawer.faults().push_back(fault(fmt::format("{}.flight.{}", drawer.place(), key), flight[key].dump(),
                                        unit_of_key(key), "none beside flight.views"));
      flight[key] = value;
    }
    flight.erase("views");
    drawer.remember("flight.views");
  }

  const Json& schema_;
  const std::string& name_;
  std::uint32_t seed_;
  DrawnConfig found_;
  Json random_;  ///< what each clip draws of the dataset's sections
  bool is_counted_ = false;
  std::map<Path, std::vector<View>> views_;
};

}  // namespace

DrawnConfig draw_config(Json document, const Json& schema, const std::string& name) {
  if (!document.is_object()) return {.document = std::move(document)};  // the schema reports it
  return Draws(std::move(document), schema, name).draw();
}

}  // namespace thermal
