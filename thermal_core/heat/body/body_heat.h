#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "heat/body/clothing.h"
#include "heat/body/coat.h"
#include "heat/body/fire.h"
#include "heat/body/vehicle_heat.h"

namespace thermal {

/// A thing without heat of its own that follows the weather within minutes: horns, a rifle.
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

/// A thing that is warmed at a constant rate, by electricity, decay or a small fire: a lamp, a generator, a dung heap.
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

/// What a camp fire does.
struct FireState {
  CampFire fire = {};   ///< its burning_s is that until the moment, or until its flames went out
  bool burning = true;  ///< has flames
  double since_s = 0;   ///< since its flames went out

  [[nodiscard]] bool operator==(const FireState&) const = default;
};

/// What heats or cools a part of an actor, or of what stands in a place; std::monostate: it has the temperature of the air.
using BodyHeat = std::variant<std::monostate, Clothing, Coat, ColdBlooded, Unheated, Sheet, EngineWarmed,
                              Powered, FirePart>;

/// ConfigError with `where` if a value is outside its domain.
void validate(const BodyHeat& heat, const std::string& where);

/// What the temperature of an actor's parts depends on at a moment. A part takes what concerns it.
struct BodyMoment {
  Surroundings around;
  Activity activity = Activity::standing;
  double dress = 0.5;  ///< of the person, 0 (thin clothes) to 1: where in its ranges
  double since_bath_s = std::numeric_limits<double>::infinity();  ///< since it left the water
  /// Temperature of what a cold-blooded animal came from, water or ground; without, that of the ground around.
  std::optional<double> refuge_k = {};
  VehicleState vehicle = {};
  FireState fire = {};
  std::optional<double> roof_k = {};  ///< of a level sheet of metal, from day_of_slab(); without, its balance
};

/// Temperature of a part where its surface has a slope [K], as the mean over all azimuths. Total for finite moments: air
/// of 230 K to 325 K, wind 0 to 20 m/s and beyond.
/// @param normal_z  of the surface's unit normal, 1 (facing the sky) to -1, clamped
[[nodiscard]] double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment,
                                        double normal_z) noexcept;

/// The same where its surface faces a direction, a unit vector; different only in sunlight.
[[nodiscard]] double part_temperature_k(const BodyHeat& heat, const BodyMoment& moment,
                                        const EastNorthUp& normal) noexcept;

/// Temperatures of a part at one moment for every direction of its surface, for use in each pixel.
struct BodyFit {
  double a_k = 0;
  double b_k = 0;
  double c_k = 0;
  double sun_k_m2_w = 0;  ///< rise per sunlight that arrives
  double error_mk =
      0;  ///< largest difference from part_temperature_k() over 41 slopes, and by day 8 azimuths

  /// a + b n + c n^2 + sun * arriving. @param sun_w_m2  of incoming_on()
  [[nodiscard]] double at_k(double normal_z, double sun_w_m2 = 0) const noexcept {
    return a_k + normal_z * (b_k + normal_z * c_k) + sun_k_m2_w * sun_w_m2;
  }
};

/// Through the Chebyshev points of the moment without sun; the rise in sunlight by a straight line through a surface that
/// faces the sun and one that faces away.
[[nodiscard]] BodyFit fit_body(const BodyHeat& heat, const BodyMoment& moment);

}  // namespace thermal
