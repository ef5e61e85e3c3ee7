#include "heat/body/vehicle_heat.h"

#include <cmath>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {

void VehicleState::validate(const std::string& where) const {
  require_range(where + ".since_s", since_s, "s", 0, 1e10);
  require_range(where + ".from_cold", from_cold, "", 0, 1);
}

void Sheet::validate(const std::string& where) const {
  surface.validate(where);
  require_range(where + ".behind_w_m2_k", behind_w_m2_k, "W/(m^2 K)", 0, 1000);
}

double sheet_k(const Sheet& sheet, const Forcing& forcing, const Incoming& incoming) noexcept {
  const HeatUptake to_behind = {.slope_w_m2_k = sheet.behind_w_m2_k,
                                .offset_w_m2 = sheet.behind_w_m2_k * forcing.air_k};
  return SurfaceBalance(sheet.surface).balanced_k(forcing, incoming, to_behind, forcing.air_k);
}

double sheet_k(const Sheet& sheet, const Surroundings& around, std::optional<double> roof_k,
               const Incoming& incoming) noexcept {
  const double balance_k = sheet_k(sheet, around.forcing, incoming);
  if (!roof_k) return balance_k;
  return *roof_k + balance_k - sheet_k(sheet, around.forcing, incoming_on_slope(around, 1));
}

void EngineWarmth::validate(const std::string& where) const {
  require_range(where + ".driving_k", driving_k, "K", 0, 900);
  require_range(where + ".idling_k", idling_k, "K", 0, 900);
  require_range(where + ".parked_k", parked_k, "K", 0, 900);
  require_range(where + ".cooling_s", cooling_s, "s", 1, 1e6);
  require_range(where + ".soak_s", soak_s, "s", 1, 1e5);
  require_range(where + ".warming_s", warming_s, "s", 1, 1e6);
  if (soak_s < cooling_s) return;
  throw ConfigError(fault(where + ".soak_s", fmt::format("{}", soak_s), "s",
                          fmt::format("below {}.cooling_s, {} s", where, cooling_s)));
}

double warmth_k(const EngineWarmth& warmth, const VehicleState& state) noexcept {
  if (state.engine != EngineState::parked) {
    const double running_k = state.engine == EngineState::driving ? warmth.driving_k : warmth.idling_k;
    return running_k * -std::expm1(-state.since_s / warmth.warming_s);
  }
  const double soaked_k = warmth.parked_k * std::exp(-state.since_s / warmth.cooling_s) -
                          (warmth.parked_k - warmth.driving_k) * std::exp(-state.since_s / warmth.soak_s);
  return state.from_cold * soaked_k;
}

}  // namespace thermal
