#include "heat/body/coat.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ranges.h"

namespace thermal {

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
