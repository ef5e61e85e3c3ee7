#pragma once

#include <array>
#include <string>
#include <variant>

#include "heat/surface/properties.h"

namespace thermal {

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
