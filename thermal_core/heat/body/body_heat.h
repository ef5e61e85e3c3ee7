#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "heat/body/fire.h"
#include "heat/body/skin.h"
#include "heat/body/vehicle_heat.h"

namespace thermal {

/// An unheated object that follows the weather within minutes: horns, a rifle.
struct Unheated {
  BodySurface surface = {.albedo = 0.3, .emissivity = 0.95, .diameter_m = 0.1};

  [[nodiscard]] bool operator==(const Unheated&) const = default;
};

/// A part of a vehicle that its engine, its wheels or its brakes warm.
struct EngineWarmed {
  Sheet sheet = {};
  EngineWarmth warmth = {};

  [[nodiscard]] bool operator==(const EngineWarmed&) const = default;
};

/// An object with constant heating, by electricity, decay or a small fire: a lamp, a generator, a dung heap.
struct Powered {
  Sheet sheet = {};
  double excess_k = 0;  ///< above what the weather alone gives it, 0 to 900

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const Powered&) const = default;
};

/// A part of a camp fire.
struct FirePart {
  enum class Of { embers, ash, flames };
  Of of = Of::ash;

  void validate(const std::string&) const {}
  [[nodiscard]] bool operator==(const FirePart&) const = default;
};

/// State of a camp fire.
struct FireState {
  CampFire fire = {};   ///< until now, or until its flames went out
  bool burning = true;  ///< has flames
  double since_s = 0;   ///< since its flames went out

  [[nodiscard]] bool operator==(const FireState&) const = default;
};

/// What sets the temperature of a part of an actor or of a structure; std::monostate: that of the air.
using BodyHeat = std::variant<std::monostate, Clothing, Coat, ColdBlooded, Unheated, Sheet, EngineWarmed,
                              Powered, FirePart>;

/// ConfigError with `where` if a value is outside its domain.
void validate(const BodyHeat& heat, const std::string& where);

/// Inputs for the temperatures of an actor's parts at one moment; each part uses some of them.
struct BodyMoment {
  Surroundings around;
  Activity activity = Activity::standing;
  double dress = 0.5;  ///< of the person, 0 (light clothes) to 1: position in its ranges
  double since_bath_s = std::numeric_limits<double>::infinity();  ///< since it left the water
  /// Temperature of the water or ground that a cold-blooded animal rested in; empty: that of the ground around it.
  std::optional<double> refuge_k = {};
  VehicleState vehicle = {};
  FireState fire = {};
  std::optional<double> roof_k = {};  ///< of a level sheet of metal, from day_of_slab(); without, its balance
};

/// Temperature of a part where its surface has a slope [K], averaged over all azimuths. Defined for all finite moments:
/// air of 230 K to 325 K, wind 0 to 20 m/s and beyond.
/// @param normal_z  of the surface's unit normal, 1 (facing the sky) to -1, clamped
[[nodiscard]] double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment,
                                        double normal_z) noexcept;

/// The same for a surface with a unit normal; different only in sunlight.
[[nodiscard]] double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment,
                                        const EastNorthUp& normal) noexcept;

}  // namespace thermal
