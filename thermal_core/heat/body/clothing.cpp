#include "heat/body/clothing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "heat/weather/humid_air.h"

namespace thermal {
namespace {

double conductance_w_m2_k(double resistance_m2_k_w) {
  return resistance_m2_k_w > 0 ? 1 / resistance_m2_k_w : std::numeric_limits<double>::infinity();
}

}  // namespace

double comfortable_skin_k(double heat_w_m2) noexcept { return 308.85 - 0.028 * heat_w_m2; }

double clothing_area_factor(double insulation_clo) noexcept {
  const double insulation = kCloM2KW * insulation_clo;
  return insulation <= 0.078 ? 1 + 1.29 * insulation : 1.05 + 0.645 * insulation;
}

double comfortable_clothing_k(double insulation_clo, double heat_w_m2, double air_k, double radiant_k,
                              double wind_m_s) noexcept {
  constexpr double kRadiating = 3.96e-8 / kStefanBoltzmann;  // emissivity 0.97, and 0.72 of the view is open
  const BodySurface surface = {.emissivity = 0.97,
                               .open_view = kRadiating / 0.97,
                               .area_factor = clothing_area_factor(insulation_clo)};
  const HeatWithin within = {.inside_k = comfortable_skin_k(heat_w_m2),
                             .w_m2_k = conductance_w_m2_k(kCloM2KW * insulation_clo)};
  // Without vapour, no dew.
  const Forcing forcing = {.air_k = air_k, .wind_m_s = wind_m_s, .pressure_hpa = 1013.25};
  return body_surface_k(surface, within, forcing,
                        {.longwave_w_m2 = kStefanBoltzmann * std::pow(radiant_k, 4)});
}

void Clothing::validate(const std::string& where) const {
  cold_clo.validate(where + ".cold_clo", "clo", 0, 20);
  warm_clo.validate(where + ".warm_clo", "clo", 0, 20);
  tissue.validate(where);
  surface.validate(where);
}

double Clothing::insulation_clo(double air_k, double uniform) const noexcept {
  constexpr double kColdAirK = 273;
  constexpr double kWarmAirK = 293;
  const double warm = std::clamp((air_k - kColdAirK) / (kWarmAirK - kColdAirK), 0.0, 1.0);
  return std::lerp(cold_clo.at(uniform), warm_clo.at(uniform), warm);
}

double clothing_surface_k(const Clothing& clothing, double insulation_clo, Activity activity,
                          const Forcing& forcing, const Incoming& incoming) noexcept {
  BodySurface surface = clothing.surface;
  surface.area_factor = clothing_area_factor(insulation_clo);
  surface.diameter_m = 0;
  Forcing moving = forcing;
  moving.wind_m_s = relative_wind_m_s(forcing.wind_m_s, metabolic_rate_w_m2(activity));
  const double resistance =
      clothing.tissue.resistance_m2_k_w(forcing.air_k, activity) + kCloM2KW * insulation_clo;
  return body_surface_k(surface,
                        {.inside_k = clothing.tissue.core_k, .w_m2_k = conductance_w_m2_k(resistance)},
                        moving, incoming);
}

}  // namespace thermal
