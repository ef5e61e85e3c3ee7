#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "heat/body/body_heat.h"
#include "heat/surface/material_heat.h"
#include "radiometry/emissivity.h"
#include "scene/weather.h"

namespace thermal {

/// How the temperature of a part of an actor or a plant differs from the mean of the whole.
struct MaterialPart {
  double excess_factor = 1;      ///< of the mean's excess over the air: 0 is at air temperature
  double offset_k = 0;           ///< added to that
  double cooling_excess_k = 0;   ///< when the engine stops; decays exponentially afterwards
  double cooling_time_s = 3600;  ///< time constant of that decay
  /// How the weather sets its temperature, instead of all of the above; empty: as the material's.
  std::optional<BodyHeat> body_heat = {};
  std::optional<MaterialHeat> heat = {};  ///< for a plant's wood beside its leaves; empty: the material's
};

/// A fractal field of temperature, fixed to the ground: mean zero.
struct TemperatureVariation {
  double stddev_k = 0;
  double correlation_length_m = 1;
};

/// What a surface is made of, as seen by a thermal camera.
struct Material {
  std::string name;
  double emissivity = 1;           ///< in band, (0, 1]
  double measured_emissivity = 1;  ///< the same where temperatures come from the heat balance, (0, 1]
  double winter_k = 273;           ///< night-time temperature, air at 273 K
  double summer_k = 293;           ///< night-time temperature, air at 293 K
  bool in_table_1 = false;         ///< one of the twelve rows of Table 1 (Bondi et al. 2018)

  // Only the physical model uses the following.
  std::optional<EmissivitySpectrum> spectrum;  ///< replaces `emissivity`
  AngularLaw angular = AngularLaw::none;
  TemperatureVariation variation;
  std::map<std::string, MaterialPart> parts;
  std::optional<MaterialHeat> heat;   ///< how its temperature follows the weather; empty: as in Table 1
  std::optional<BodyHeat> body_heat;  ///< of an actor's parts that state none of their own

  /// Whether what is beyond it is seen in it, as in still water.
  [[nodiscard]] bool mirrors() const noexcept { return angular == AngularLaw::water; }

  /// ConfigError if a value is outside its domain.
  void validate() const;

  /// Night-time temperature in one of Table 1's seasons [K].
  [[nodiscard]] double temperature_k(Season season) const noexcept;

  /// Temperature [K] at any air temperature: the straight line through both nights of Table 1, including the table's
  /// oddities (soil is warmer than air in winter and cooler in summer).
  [[nodiscard]] double temperature_k(double air_k) const noexcept;

  /// Temperature [K] of a part of an actor; of the whole actor if `part` is empty or not listed.
  [[nodiscard]] double part_temperature_k(const std::string& part, const Weather& weather) const noexcept;

  /// Heat model of a part of an actor, or of the whole actor if `part` is empty or not listed; nullptr if there is
  /// none.
  [[nodiscard]] const BodyHeat* body_heat_of(const std::string& part) const noexcept;

  /// Heat model of a part of a plant: its own, or else the material's; nullptr if there is none.
  [[nodiscard]] const MaterialHeat* heat_of(const std::string& part) const noexcept;

  /// Name of that model among those of all materials: "acacia", or "acacia wood" if the part has its own.
  [[nodiscard]] std::string heat_name(const std::string& part) const;
};

/// Materials by name.
class MaterialLibrary {
 public:
  /// ConfigError if a material is invalid or a name is repeated.
  void add(Material material);

  /// ConfigError with `where` and the nearest known name if the material is unknown.
  [[nodiscard]] const Material& find(const std::string& name, const std::string& where) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const std::map<std::string, Material>& all() const noexcept { return materials_; }

 private:
  std::map<std::string, Material> materials_;
};

}  // namespace thermal
