#include "scene/material.h"

#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "base/error.h"
#include "base/plausible.h"
#include "base/text.h"

namespace thermal {
namespace {

void check_temperature(const std::string& where, double value_k) {
  if (value_k > 0 && value_k <= kTemperatureK.most) return;
  throw ConfigError(fault(where, fmt::format("{}", value_k), "K",
                          fmt::format("above 0 K and at most {} K", kTemperatureK.most)));
}

void check_positive(const std::string& where, double value, const char* unit) {
  if (value > 0 && std::isfinite(value)) return;
  throw ConfigError(fault(where, fmt::format("{}", value), unit, "more than 0"));
}

void check_not_negative(const std::string& where, double value, const char* unit) {
  if (value >= 0 && std::isfinite(value)) return;
  throw ConfigError(fault(where, fmt::format("{}", value), unit, "at least 0"));
}

}  // namespace

void Material::validate() const {
  const std::string where = "material " + name;
  require_share_above_0(where + ": emissivity", emissivity);
  require_share_above_0(where + ": measured_emissivity", measured_emissivity);
  check_temperature(where + ": winter_k", winter_k);
  check_temperature(where + ": summer_k", summer_k);
  check_not_negative(where + ": variation.stddev_k", variation.stddev_k, "K");
  check_positive(where + ": variation.correlation_length_m", variation.correlation_length_m, "m");
  for (const auto& [part, values] : parts) {
    check_positive(where + ": parts." + part + ".cooling_time_s", values.cooling_time_s, "s");
    if (values.heat) thermal::validate(*values.heat, where + ": parts." + part + ".heat");
  }
  if (heat) thermal::validate(*heat, where + ": heat");
}

double Material::temperature_k(Season season) const noexcept {
  return season == Season::winter ? winter_k : summer_k;
}

double Material::temperature_k(double air_k) const noexcept {
  constexpr double kWinterAir = 273;
  constexpr double kSummerAir = 293;
  return winter_k + (summer_k - winter_k) * (air_k - kWinterAir) / (kSummerAir - kWinterAir);
}

double Material::part_temperature_k(const std::string& part, const Weather& weather) const noexcept {
  constexpr double kStoppedS = 3600;  // where the weather does not say it
  const double air_k = weather.air.temperature_k;
  const double mean_k = temperature_k(air_k);
  const auto found = parts.find(part);
  if (found == parts.end()) return mean_k;
  const MaterialPart& p = found->second;
  const double cooling_k =
      p.cooling_excess_k * std::exp(-weather.vehicle_stopped_s.value_or(kStoppedS) / p.cooling_time_s);
  return air_k + p.excess_factor * (mean_k - air_k) + p.offset_k + cooling_k;
}

const BodyHeat* Material::body_heat_of(const std::string& part) const noexcept {
  const auto found = parts.find(part);
  if (found != parts.end() && found->second.body_heat) return &*found->second.body_heat;
  return body_heat ? &*body_heat : nullptr;
}

const MaterialHeat* Material::heat_of(const std::string& part) const noexcept {
  const auto found = parts.find(part);
  if (found != parts.end() && found->second.heat) return &*found->second.heat;
  return heat ? &*heat : nullptr;
}

std::string Material::heat_name(const std::string& part) const {
  const auto found = parts.find(part);
  return found != parts.end() && found->second.heat ? name + " " + part : name;
}

void MaterialLibrary::add(Material material) {
  material.validate();
  const std::string name = material.name;
  if (!materials_.emplace(name, std::move(material)).second) {
    throw ConfigError(fmt::format("material {} is defined twice; expected unique names", name));
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
