#include "heat/surface/material_heat.h"

#include <algorithm>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

template <typename Properties>
Properties interpolated(const ByMoisture<Properties>& states, double moisture) noexcept {
  const double position = 2 * std::clamp(moisture, 0.0, 1.0);
  return position < 1 ? between(states[0], states[1], position) : between(states[1], states[2], position - 1);
}

template <typename Properties>
void validate_states(const ByMoisture<Properties>& states, const std::string& where) {
  for (const Properties& state : states) state.validate(where);
}

}  // namespace

GroundProperties at_moisture(const ByMoisture<GroundProperties>& states, double moisture) noexcept {
  return interpolated(states, moisture);
}

CanopyProperties at_moisture(const ByMoisture<CanopyProperties>& states, double moisture) noexcept {
  return interpolated(states, moisture);
}

void GroundHeat::validate(const std::string& where) const { validate_states(states, where); }

void LeavesHeat::validate(const std::string& where) const {
  validate_states(states, where);
  if (leaf_density_m2_m3 > 0 && leaf_density_m2_m3 <= 100) return;
  throw ConfigError(fault(where + ".leaf_density_m2_m3", fmt::format("{}", leaf_density_m2_m3), "m^2/m^3",
                          "above 0 and at most 100"));
}

void SlabHeat::validate(const std::string& where) const { properties.validate(where); }

void validate(const MaterialHeat& heat, const std::string& where) {
  std::visit([&where](const auto& kind) { kind.validate(where); }, heat);
}

}  // namespace thermal
