#include "io/config/random_values.h"

#include <string>
#include <utility>
#include <vector>

#include "io/config/distribution.h"

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

}  // namespace thermal
