#pragma once

#include <cmath>

#include "heat/body/body_surface.h"
#include "heat/weather/humid_air.h"

/// Nights without sun: air at 273 K with 60 % humidity or at 293 K with 70 %, clear, at 900 m.
inline thermal::Surroundings night(double air_k, double wind_m_s, double ground_k) {
  const double vapour_hpa = (air_k < 283 ? 0.6 : 0.7) * thermal::saturation_hpa(air_k);
  return {.forcing = {.air_k = air_k,
                      .wind_m_s = wind_m_s,
                      .vapour_hpa = vapour_hpa,
                      .pressure_hpa = thermal::pressure_hpa(900),
                      .sky_w_m2 = thermal::broadband_sky_emissivity(air_k, vapour_hpa, 0) *
                                  thermal::kStefanBoltzmann * std::pow(air_k, 4),
                      .sun = {0, 0, -1}},
          .ground_k = ground_k};
}

inline thermal::Surroundings cold_night() { return night(273, 1, 268); }
inline thermal::Surroundings warm_night() { return night(293, 1, 291.5); }

/// The sun 40 deg above the horizon in the north.
inline thermal::Surroundings sunny_day(double air_k, double wind_m_s) {
  thermal::Surroundings day = night(air_k, wind_m_s, air_k + 12);
  day.forcing.sun = {0, std::cos(0.7), std::sin(0.7)};
  day.forcing.beam_w_m2 = 780;
  day.forcing.diffuse_w_m2 = 90;
  day.forcing.global_w_m2 = 780 * std::sin(0.7) + 90;
  return day;
}
