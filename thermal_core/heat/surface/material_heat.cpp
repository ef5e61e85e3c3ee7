#include "heat/surface/material_heat.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {

void SurfaceProperties::validate(const std::string& where) const {
  require_range(where + ".albedo", albedo, "", 0, 1);
  require_share_above_0(where + ".broadband_emissivity", emissivity);
  if (roughness_m != 0) require_range(where + ".roughness_m", roughness_m, "m", 1e-5, 0.5);
  require_range(where + ".evaporation", evaporation, "", 0, 1);
}

void GroundProperties::validate(const std::string& where) const {
  surface.validate(where);
  require_range(where + ".conductivity_w_m_k", conductivity_w_m_k, "W/(m K)", 0.01, 100);
  require_range(where + ".heat_capacity_j_m3_k", heat_capacity_j_m3_k, "J/(m^3 K)", 1e3, 1e7);
  require_range(where + ".thickness_m", thickness_m, "m", 0.001, 10);
  if (!subsoil) return;
  const std::string below = where + ".subsoil";
  require_range(below + ".depth_m", subsoil->depth_m, "m", 0.001, thickness_m);
  require_range(below + ".conductivity_w_m_k", subsoil->conductivity_w_m_k, "W/(m K)", 0.01, 100);
  require_range(below + ".heat_capacity_j_m3_k", subsoil->heat_capacity_j_m3_k, "J/(m^3 K)", 1e3, 1e7);
}

GroundProperties between(const GroundProperties& a, const GroundProperties& b, double share) noexcept {
  const auto mix = [share](double from, double to) { return std::lerp(from, to, share); };
  return {.surface = {.albedo = mix(a.surface.albedo, b.surface.albedo),
                      .emissivity = mix(a.surface.emissivity, b.surface.emissivity),
                      .roughness_m = mix(a.surface.roughness_m, b.surface.roughness_m),
                      .evaporation = mix(a.surface.evaporation, b.surface.evaporation)},
          .conductivity_w_m_k = mix(a.conductivity_w_m_k, b.conductivity_w_m_k),
          .heat_capacity_j_m3_k = mix(a.heat_capacity_j_m3_k, b.heat_capacity_j_m3_k),
          .thickness_m = mix(a.thickness_m, b.thickness_m),
          .subsoil = a.subsoil};
}

void SlabProperties::validate(const std::string& where) const {
  surface.validate(where);
  require_range(where + ".heat_capacity_j_m2_k", heat_capacity_j_m2_k, "J/(m^2 K)", 100, 1e9);
  require_range(where + ".behind_w_m2_k", behind_w_m2_k, "W/(m^2 K)", 0, 1000);
}

void CanopyProperties::validate(const std::string& where) const {
  require_range(where + ".leaf_area_index", leaf_area_index, "", 0.05, 10);
  require_range(where + ".albedo", albedo, "", 0, 1);
  require_share_above_0(where + ".broadband_emissivity", emissivity);
  require_range(where + ".leaf_width_m", leaf_width_m, "m", 0.0005, 1);
  require_range(where + ".height_m", height_m, "m", 0.005, 50);
  require_range(where + ".leaf_conductance_m_s", leaf_conductance_m_s, "m/s", 0, 0.05);
  require_range(where + ".heat_capacity_j_m2_k", heat_capacity_j_m2_k, "J/(m^2 K)", 10, 1e5);
}

double CanopyProperties::cover() const noexcept { return 1 - std::exp(-0.5 * leaf_area_index); }

CanopyProperties between(const CanopyProperties& a, const CanopyProperties& b, double share) noexcept {
  const auto mix = [share](double from, double to) { return std::lerp(from, to, share); };
  return {.leaf_area_index = mix(a.leaf_area_index, b.leaf_area_index),
          .albedo = mix(a.albedo, b.albedo),
          .emissivity = mix(a.emissivity, b.emissivity),
          .leaf_width_m = mix(a.leaf_width_m, b.leaf_width_m),
          .height_m = mix(a.height_m, b.height_m),
          .leaf_conductance_m_s = mix(a.leaf_conductance_m_s, b.leaf_conductance_m_s),
          .heat_capacity_j_m2_k = mix(a.heat_capacity_j_m2_k, b.heat_capacity_j_m2_k)};
}

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
