#pragma once

#include <vector>

#include "heat/surface/material_heat.h"
#include "heat/surface/surface_balance.h"

namespace thermal {

/// Layers that a body is divided into, from its surface down; each is `ratio` times as thick as the one above. One ends
/// where the subsoil begins, the last at the body's thickness.
struct Layers {
  double first_m = 0.004;  ///< 1e-4 to 1
  double ratio = 1.2;      ///< 1 to 3

  /// Their thicknesses [m]; at least one.
  [[nodiscard]] std::vector<double> thicknesses_m(const GroundProperties& properties) const;

  [[nodiscard]] bool operator==(const Layers&) const = default;
};

/// Heat conduction in a body, from its surface down to where no heat passes: layers of one temperature each, implicit in time (backward Euler), so it is stable for steps of any length and its errors are of
/// first order in the step, of second in the layers.
class Conduction {
 public:
  /// All layers start at `start_k`. `step_s` above 0.
  Conduction(const GroundProperties& properties, const Layers& layers, double step_s, double start_k);

  /// Heat uptake in the next step, as a function of the surface's temperature at the step's end.
  [[nodiscard]] HeatUptake prepare() noexcept;

  /// Ends the prepared step with that surface temperature. Returns the heat flux into the body [W m^-2].
  double finish(double surface_k) noexcept;

  /// Temperatures of the layers [K].
  [[nodiscard]] const std::vector<double>& layers_k() const noexcept { return temperature_k_; }
  void set_layers_k(const std::vector<double>& temperatures_k) { temperature_k_ = temperatures_k; }

 private:
  double to_surface_w_m2_k_ = 0;       ///< from the middle of the first layer
  std::vector<double> stored_w_m2_k_;  ///< by layer: heat capacity per step
  std::vector<double> below_w_m2_k_;   ///< by layer: conductance to the next one; 0 for the last
  std::vector<double> follow_;         ///< by layer: how much it follows the one above
  std::vector<double> per_total_;      ///< by layer: 1 / (what it stores and exchanges)
  std::vector<double> own_k_;          ///< by layer: the part of its new temperature that is not from above
  std::vector<double> temperature_k_;
};

}  // namespace thermal
