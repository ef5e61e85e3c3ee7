#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace thermal {

/// How a surface exchanges heat with what is above it.
struct SurfaceProperties {
  double albedo = 0.28;        ///< share of sunlight that it reflects, 0 to 1
  double emissivity = 0.93;    ///< over all wavelengths, above 0 to 1
  double roughness_m = 0.005;  ///< of level ground, 1e-5 to 0.5; 0: of a body that stands in the wind
  double evaporation = 0.03;   ///< share of what a wet surface evaporates, 0 to 1; dew falls on all

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const SurfaceProperties&) const = default;
};

/// What lies below the top layer of ground: rock under soil, soil under a road.
struct Subsoil {
  double depth_m = 0.2;                  ///< where it begins, 0.001 to below the ground's thickness
  double conductivity_w_m_k = 0.3;       ///< 0.01 to 100
  double heat_capacity_j_m3_k = 1.28e6;  ///< 1e3 to 1e7

  [[nodiscard]] bool operator==(const Subsoil&) const = default;
};

/// Ground, or another body that the heat of a day passes into: rock, a trunk.
struct GroundProperties {
  SurfaceProperties surface;
  double conductivity_w_m_k = 0.3;       ///< 0.01 to 100
  double heat_capacity_j_m3_k = 1.28e6;  ///< 1e3 to 1e7
  double thickness_m = 1.4;              ///< 0.001 to 10; no heat passes deeper
  std::optional<Subsoil> subsoil = {};   ///< from its depth on, instead of the properties above

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const GroundProperties&) const = default;
};

/// A body of one temperature: still water, a sheet of metal.
struct SlabProperties {
  SurfaceProperties surface = {.albedo = 0.07, .emissivity = 0.97, .roughness_m = 0.0002, .evaporation = 1};
  double heat_capacity_j_m2_k = 4.18e6;  ///< 100 to 1e9
  double behind_w_m2_k = 0;              ///< to air behind it, 0 to 1000

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const SlabProperties&) const = default;
};

/// A layer of leaves above ground, which shades and warms it.
struct CanopyProperties {
  double leaf_area_index = 1;       ///< area of leaves above an area of ground, 0.05 to 10
  double albedo = 0.22;             ///< share of sunlight that leaves reflect, 0 to 1
  double emissivity = 0.97;         ///< of leaves over all wavelengths, above 0 to 1
  double leaf_width_m = 0.004;      ///< 0.0005 to 1
  double height_m = 0.04;           ///< of the leaves, 0.005 to 50; below 0.1 m they are in the ground's air
  double leaf_conductance_m_s = 0;  ///< of open stomata to vapour, 0 (dry leaves) to 0.05
  double heat_capacity_j_m2_k = 600;  ///< of an area of leaves, 10 to 1e5

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  /// Share of the ground that leaves hide from above, 1 - exp(-LAI / 2): leaves of all directions.
  [[nodiscard]] double cover() const noexcept;

  [[nodiscard]] bool operator==(const CanopyProperties&) const = default;
};

/// Properties between two others: 0 is `a`, 1 is `b`. Both have the same subsoil.
[[nodiscard]] GroundProperties between(const GroundProperties& a, const GroundProperties& b,
                                       double share) noexcept;
/// The same of leaves.
[[nodiscard]] CanopyProperties between(const CanopyProperties& a, const CanopyProperties& b,
                                       double share) noexcept;

/// Properties at three states of moisture, between which they are interpolated: dry, moist (half), wet (saturated).
template <typename Properties>
using ByMoisture = std::array<Properties, 3>;

/// Properties at a moisture from 0, dry, to 1, saturated.
[[nodiscard]] GroundProperties at_moisture(const ByMoisture<GroundProperties>& states,
                                           double moisture) noexcept;
/// The same of leaves.
[[nodiscard]] CanopyProperties at_moisture(const ByMoisture<CanopyProperties>& states,
                                           double moisture) noexcept;

/// Soil, rock, a road, a trunk.
struct GroundHeat {
  ByMoisture<GroundProperties> states;
  bool is_body = false;  ///< faces all directions, as stones and trunks do; ground faces up

  void validate(const std::string& where) const;
  [[nodiscard]] bool operator==(const GroundHeat&) const = default;
};

/// Leaves above ground of another material.
struct LeavesHeat {
  ByMoisture<CanopyProperties> states;
  std::string ground = "soil";    ///< material with GroundHeat
  bool is_cover = false;          ///< grass: a camera sees leaves and the ground between them; crowns: leaves
  double leaf_density_m2_m3 = 1;  ///< of a crown: area of leaves in its volume, above 0 to 100

  void validate(const std::string& where) const;
  [[nodiscard]] bool operator==(const LeavesHeat&) const = default;
};

/// Still water, sheets of metal.
struct SlabHeat {
  SlabProperties properties;
  bool is_body = false;  ///< faces all directions; water faces up

  void validate(const std::string& where) const;
  [[nodiscard]] bool operator==(const SlabHeat&) const = default;
};

/// How a material's temperature follows the weather.
using MaterialHeat = std::variant<GroundHeat, LeavesHeat, SlabHeat>;

/// ConfigError with `where` if a value is outside its domain.
void validate(const MaterialHeat& heat, const std::string& where);

}  // namespace thermal
