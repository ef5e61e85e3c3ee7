#include "io/config/material_heat.h"

#include <array>
#include <optional>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// One of three states of moisture, or the one number for all of them.
double at_state(const Json& value, std::size_t state) { return value.is_array() ? value[state] : value; }

SurfaceProperties read_surface(const Json& json, std::size_t state) {
  return {.albedo = at_state(json["albedo"], state),
          .emissivity = at_state(json["broadband_emissivity"], state),
          .roughness_m = at_state(json["roughness_m"], state),
          .evaporation = at_state(json["evaporation"], state)};
}

std::optional<Subsoil> read_subsoil(const Json& ground) {
  if (!ground.contains("subsoil")) return std::nullopt;
  const Json& json = ground["subsoil"];
  return Subsoil{.depth_m = json["depth_m"],
                 .conductivity_w_m_k = json["conductivity_w_m_k"],
                 .heat_capacity_j_m3_k = json["heat_capacity_j_m3_k"]};
}

GroundProperties read_ground(const Json& json, std::size_t state) {
  return {.surface = read_surface(json, state),
          .conductivity_w_m_k = at_state(json["conductivity_w_m_k"], state),
          .heat_capacity_j_m3_k = at_state(json["heat_capacity_j_m3_k"], state),
          .thickness_m = json["thickness_m"],
          .subsoil = read_subsoil(json)};
}

CanopyProperties read_canopy(const Json& json, std::size_t state) {
  return {.leaf_area_index = at_state(json["leaf_area_index"], state),
          .albedo = at_state(json["albedo"], state),
          .emissivity = json["broadband_emissivity"],
          .leaf_width_m = at_state(json["leaf_width_m"], state),
          .height_m = json["height_m"],
          .leaf_conductance_m_s = at_state(json["leaf_conductance_m_s"], state),
          .heat_capacity_j_m2_k = at_state(json["heat_capacity_j_m2_k"], state)};
}

}  // namespace

MaterialHeat read_material_heat(const Json& json, const std::string& where) {
  std::vector<std::string> kinds;
  for (const char* kind : {"ground", "leaves", "slab"}) {
    if (json.contains(kind)) kinds.emplace_back(kind);
  }
  if (kinds.size() != 1)
    throw ConfigError(
        fault(where, kinds.empty() ? "nothing" : list_names(kinds), "", "one of ground, leaves and slab"));
  const Json& values = json[kinds.front()];
  const bool is_body = json["is_body"];
  if (kinds.front() == "ground")
    return GroundHeat{.states = {read_ground(values, 0), read_ground(values, 1), read_ground(values, 2)},
                      .is_body = is_body};
  if (kinds.front() == "leaves")
    return LeavesHeat{.states = {read_canopy(values, 0), read_canopy(values, 1), read_canopy(values, 2)},
                      .ground = values["ground"],
                      .is_cover = values["is_cover"],
                      .leaf_density_m2_m3 = values["leaf_density_m2_m3"]};
  return SlabHeat{.properties = {.surface = read_surface(values, 0),
                                 .heat_capacity_j_m2_k = values["heat_capacity_j_m2_k"],
                                 .behind_w_m2_k = values["behind_w_m2_k"]},
                  .is_body = is_body};
}

}  // namespace thermal
