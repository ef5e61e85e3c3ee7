#pragma once

#include "heat/surface/surface_day.h"

/// Two nights, and what lies in them, as the tests of whole days use them.
namespace heat_cases {

inline thermal::DayWeather winter() { return {}; }

inline thermal::DayWeather summer() {
  thermal::DayWeather weather;
  weather.sun.day_of_year = 15;
  weather.air_min_k = 291.8;
  weather.air_max_k = 302;
  weather.vapour_hpa = 16.2;
  weather.cloud_fraction = 0.3;
  weather.day_wind_m_s = 3;
  return weather;
}

inline thermal::GroundProperties dry_soil() { return {}; }
inline thermal::GroundProperties moist_soil() {
  return {.surface = {.albedo = 0.2, .emissivity = 0.95, .roughness_m = 0.005, .evaporation = 0.5},
          .conductivity_w_m_k = 1.1,
          .heat_capacity_j_m3_k = 2e6};
}
inline thermal::GroundProperties wet_soil() {
  return {.surface = {.albedo = 0.14, .emissivity = 0.96, .roughness_m = 0.003, .evaporation = 1},
          .conductivity_w_m_k = 1.8,
          .heat_capacity_j_m3_k = 2.8e6};
}
inline thermal::GroundProperties rock() {
  return {.surface = {.albedo = 0.28, .emissivity = 0.93, .roughness_m = 0.01, .evaporation = 0},
          .conductivity_w_m_k = 2.6,
          .heat_capacity_j_m3_k = 2.25e6};
}
inline thermal::GroundProperties dry_road() {
  return {.surface = {.albedo = 0.28, .emissivity = 0.93, .roughness_m = 0.002, .evaporation = 0},
          .conductivity_w_m_k = 0.9,
          .heat_capacity_j_m3_k = 1.9e6};
}
inline thermal::GroundProperties moist_road() {
  return {.surface = {.albedo = 0.22, .emissivity = 0.94, .roughness_m = 0.002, .evaporation = 0.2},
          .conductivity_w_m_k = 1.3,
          .heat_capacity_j_m3_k = 2.2e6};
}
inline thermal::GroundProperties bark() {
  return {.surface = {.albedo = 0.2, .emissivity = 0.95, .roughness_m = 0, .evaporation = 0},
          .conductivity_w_m_k = 0.35,
          .heat_capacity_j_m3_k = 2e6};
}
inline thermal::SlabProperties steel_roof() {
  return {.surface = {.albedo = 0.35, .emissivity = 0.92, .roughness_m = 0, .evaporation = 0},
          .heat_capacity_j_m2_k = 7850 * 470 * 0.0012 + 800,
          .behind_w_m2_k = 2};
}
inline thermal::CanopyProperties dry_grass() { return {}; }
inline thermal::CanopyProperties green_grass() {
  return {.leaf_area_index = 2.5,
          .albedo = 0.2,
          .leaf_width_m = 0.006,
          .leaf_conductance_m_s = 1.0 / 80,
          .heat_capacity_j_m2_k = 900};
}
inline thermal::CanopyProperties dry_crown() {
  return {.leaf_area_index = 0.9,
          .albedo = 0.18,
          .leaf_width_m = 0.006,
          .height_m = 5,
          .leaf_conductance_m_s = 1.0 / 250,
          .heat_capacity_j_m2_k = 1200};
}
inline thermal::CanopyProperties green_crown() {
  return {.leaf_area_index = 2,
          .albedo = 0.16,
          .leaf_width_m = 0.006,
          .height_m = 5,
          .leaf_conductance_m_s = 1.0 / 100,
          .heat_capacity_j_m2_k = 1200};
}

}  // namespace heat_cases
