#include "io/config/random_values.h"

#include <fmt/format.h>

namespace thermal {
namespace {

const Json kAnyValue = Json::object();

/// The schema's rules for a member of an object.
const Json& rules_for(const Json& rules, const std::string& key) {
  if (const auto properties = rules.find("properties"); properties != rules.end())
    if (const auto found = properties->find(key); found != properties->end()) return *found;
  const auto others = rules.find("additionalProperties");
  return others != rules.end() && others->is_object() ? *others : kAnyValue;
}

const Json& rules_for_items(const Json& rules) {
  const auto items = rules.find("items");
  return items == rules.end() ? kAnyValue : *items;
}

/// Of a list, which is taken as a whole.
bool has_distribution_in_list(const Json& value, const Json& rules) {
  if (!value.is_array()) return false;
  const Json& its_rules = rules_for_items(rules);
  for (const Json& entry : value)
    if (is_distribution(entry, its_rules) || has_distribution_in_list(entry, its_rules)) return true;
  return false;
}

std::string member_of(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

}  // namespace

std::vector<std::string> draw_within(Json& value, const Json& rules, const DrawKey& key,
                                     const std::string& where, std::vector<std::string>& faults) {
  if (is_distribution(value, rules)) {
    value = drawn_value(value, rules, key, where, faults);
    return {key.path};
  }
  std::vector<std::string> drawn;
  const auto add = [&](Json& member, const Json& its_rules, const std::string& path,
                       const std::string& place) {
    const DrawKey its_key = {.seed = key.seed, .owner = key.owner, .path = path};
    const std::vector<std::string> inner = draw_within(member, its_rules, its_key, place, faults);
    drawn.insert(drawn.end(), inner.begin(), inner.end());
  };
  if (value.is_object()) {
    for (const auto& [name, member] : value.items())
      add(member, rules_for(rules, name), member_of(key.path, name), member_of(where, name));
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k)
      add(value[k], rules_for_items(rules), fmt::format("{}[{}]", key.path, k),
          fmt::format("{}[{}]", where, k));
  }
  return drawn;
}

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

}  // namespace thermal
