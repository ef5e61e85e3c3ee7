#pragma once

#include <optional>
#include <string>

#include "heat/body/body_surface.h"
#include "heat/surface/material_heat.h"

namespace thermal {

/// What a vehicle's engine does.
enum class EngineState {
  driving,
  idling,  ///< runs while the vehicle stands
  parked   ///< off
};

/// State of a vehicle's engine.
struct VehicleState {
  EngineState engine = EngineState::parked;
  double since_s = 1e9;  ///< since when, at least 0
  double from_cold = 1;  ///< share of its full heat that it had when it stopped, 0 to 1

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const VehicleState&) const = default;
};

/// A sheet of metal, cloth or glass that follows the weather within minutes.
struct Sheet {
  SurfaceProperties surface = {.albedo = 0.4, .emissivity = 0.92, .roughness_m = 0, .evaporation = 0};
  double behind_w_m2_k = 3;  ///< to air behind it, 0 to 1000

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const Sheet&) const = default;
};

/// Temperature of a sheet in balance with what arrives at it [K]. A body panel stores about 3 kJ m^-2 K^-1 (0.8 mm of
/// steel) and lags by 3 to 6 min, which is left out.
[[nodiscard]] double sheet_k(const Sheet& sheet, const Forcing& forcing, const Incoming& incoming) noexcept;

/// The same, corrected by `roof_k`, which day_of_slab() computes for a level sheet with the heat that it stores: then the
/// balance gives only the difference from a level sheet.
[[nodiscard]] double sheet_k(const Sheet& sheet, const Surroundings& around, std::optional<double> roof_k,
                             const Incoming& incoming) noexcept;

/// Excess temperature of a part of a vehicle over what the weather gives it.
struct EngineWarmth {
  double driving_k = 0;  ///< after a long drive, 0 to 900
  double idling_k = 0;   ///< after a long time with the engine running while it stands, 0 to 900
  double parked_k = 0;  ///< to which it tends just after stopping, when no wind of driving cools it, 0 to 900
  double soak_s = 300;  ///< time constant of that rise, 1 to 1e5; shorter than cooling_s
  double cooling_s = 3600;  ///< time constant of its decay, 1 to 1e6
  double warming_s = 600;   ///< time constant of warming up, 1 to 1e6

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const EngineWarmth&) const = default;
};

/// Excess [K]: driving, driving_k (1 - exp(-t / warming)); idling, the same with idling_k; parked, parked_k
/// exp(-t / cooling) - (parked_k - driving_k) exp(-t / soak), times the share of heat that it had.
[[nodiscard]] double warmth_k(const EngineWarmth& warmth, const VehicleState& state) noexcept;

}  // namespace thermal
