#include "heat/body/skin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

constexpr double kMetWM2 = 58.15;

}  // namespace

double DrawnRange::at(double uniform) const noexcept {
  return std::lerp(low, high, std::clamp(uniform, 0.0, 1.0));
}

void DrawnRange::validate(const std::string& where, const char* unit, double lowest, double highest) const {
  require_range(where + "[0]", low, unit, lowest, highest);
  require_range(where + "[1]", high, unit, low, highest);
}

double metabolic_rate_w_m2(Activity activity) noexcept {
  return (activity == Activity::walking ? 2.6 : 1.2) * kMetWM2;
}

double relative_wind_m_s(double wind_m_s, double metabolic_w_m2) noexcept {
  return wind_m_s + 0.3 * std::max(0.0, metabolic_w_m2 / kMetWM2 - 1);
}

void Tissue::validate(const std::string& where) const {
  require_range(where + ".core_k", core_k, "K", 270, 320);
  require_range(where + ".warm_tissue_m2_k_w", warm_m2_k_w, "m^2 K/W", 0, 10);
  require_range(where + ".cold_tissue_m2_k_w", cold_m2_k_w, "m^2 K/W", warm_m2_k_w, 10);
}

double Tissue::resistance_m2_k_w(double air_k, Activity activity) const noexcept {
  constexpr double kColdAirK = 283;
  constexpr double kWarmAirK = 303;
  const double felt_k = air_k + (activity == Activity::walking ? 10 : 0);
  const double open = std::clamp((felt_k - kColdAirK) / (kWarmAirK - kColdAirK), 0.0, 1.0);
  return std::lerp(cold_m2_k_w, warm_m2_k_w, open);
}

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

void Coat::validate(const std::string& where) const {
  tissue.validate(where);
  require_range(where + ".coat_m2_k_w", coat_m2_k_w, "m^2 K/W", 0, 10);
  require_range(where + ".wet_when_bathed", wet_when_bathed, "", 0, 1);
  require_range(where + ".drying_s", drying_s, "s", 1, 1e6);
  surface.validate(where);
}

double wet_share(const Coat& coat, double since_bath_s) noexcept {
  return std::max(coat.surface.wet, coat.wet_when_bathed * std::exp(-since_bath_s / coat.drying_s));
}

double resting_tissue_m2_k_w(double air_k) noexcept {
  constexpr double kColdM2KW = 0.1;
  constexpr double kColdAirK = 283;
  constexpr double kMildAirK = 293;
  return kColdM2KW * std::clamp((kMildAirK - air_k) / (kMildAirK - kColdAirK), 0.0, 1.0);
}

double coat_surface_k(const Coat& coat, Activity activity, double since_bath_s, const Forcing& forcing,
                      const Incoming& incoming) noexcept {
  BodySurface surface = coat.surface;
  surface.wet = wet_share(coat, since_bath_s);
  Forcing moving = forcing;
  double resistance = coat.tissue.resistance_m2_k_w(forcing.air_k, activity) + coat.coat_m2_k_w;
  if (surface.diameter_m <= 0) {
    moving.wind_m_s = relative_wind_m_s(forcing.wind_m_s, metabolic_rate_w_m2(activity));
  } else if (activity == Activity::standing) {
    resistance += resting_tissue_m2_k_w(forcing.air_k);
  }
  const double conductance = resistance > 0 ? 1 / resistance : std::numeric_limits<double>::infinity();
  return body_surface_k(surface, {.inside_k = coat.tissue.core_k, .w_m2_k = conductance}, moving, incoming);
}

void ColdBlooded::validate(const std::string& where) const {
  require_range(where + ".above_k", above_k, "K", -20, 20);
  require_range(where + ".tissue_m2_k_w", tissue_m2_k_w, "m^2 K/W", 1e-4, 10);
  surface.validate(where);
}

double cold_blooded_surface_k(const ColdBlooded& body, double refuge_k, const Forcing& forcing,
                              const Incoming& incoming) noexcept {
  const HeatWithin within = {.inside_k = refuge_k + body.above_k, .w_m2_k = 1 / body.tissue_m2_k_w};
  return body_surface_k(body.surface, within, forcing, incoming);
}

}  // namespace thermal
