#include "scene/material.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

void check_temperature(const std::string& where, double value_k) {
  constexpr double kHottest = 2000;
  if (value_k > 0 && value_k <= kHottest) return;
  throw ConfigError(
      fault(where, fmt::format("{}", value_k), "K", fmt::format("above 0 K and at most {} K", kHottest)));
}

}  // namespace

void Material::validate() const {
  const std::string where = "material " + name;
  if (!(emissivity > 0 && emissivity <= 1)) {
    throw ConfigError(
        fault(where + ": emissivity", fmt::format("{}", emissivity), "", "above 0 and at most 1"));
  }
  check_temperature(where + ": winter_k", winter_k);
  check_temperature(where + ": summer_k", summer_k);
}

double Material::temperature_k(Season season) const noexcept {
  return season == Season::winter ? winter_k : summer_k;
}

void MaterialLibrary::add(Material material) {
  material.validate();
  const std::string name = material.name;
  if (!materials_.emplace(name, std::move(material)).second) {
    throw ConfigError(fmt::format("material {} is there twice; expected one of each name", name));
  }
}

const Material& MaterialLibrary::find(const std::string& name, const std::string& where) const {
  const auto found = materials_.find(name);
  if (found != materials_.end()) return found->second;
  const std::vector<std::string> known = names();
  throw ConfigError(fault(where, fmt::format("\"{}\"", name), "", "one of " + list_names(known, 40)) +
                    did_you_mean(name, known));
}

std::vector<std::string> MaterialLibrary::names() const {
  std::vector<std::string> names;
  for (const auto& [name, material] : materials_) names.push_back(name);
  return names;
}

}  // namespace thermal
