#include "heat/body/clothing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermal {
namespace {

double conductance_w_m2_k(double resistance_m2_k_w) {
  return resistance_m2_k_w > 0 ? 1 / resistance_m2_k_w : std::numeric_limits<double>::infinity();
}

}  // namespace

double clothing_area_factor(double insulation_clo) noexcept {
  const double insulation = kCloM2KW * insulation_clo;
  return insulation <= 0.078 ? 1 + 1.29 * insulation : 1.05 + 0.645 * insulation;
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
