#pragma once

namespace thermal {

/// Pressure of the standard atmosphere [hPa] at a height above the sea (ISO 2533), -500 m to 9000 m.
[[nodiscard]] double pressure_hpa(double elevation_m) noexcept;

/// Density of dry air [kg m^-3]; vapour makes humid air lighter by up to 1.5 %, which is left out.
[[nodiscard]] double air_density_kg_m3(double pressure_hpa, double temperature_k) noexcept;

/// Partial pressure of water vapour at saturation over water [hPa]: Magnus form with 17.62 and 243.12 C (WMO-No. 8,
/// 2018), within 0.35 % from 260 K to 333 K, 0.8 % from 228 K. Clamped to 190 K and 420 K, so that it is finite everywhere; NaN stays.
[[nodiscard]] double saturation_hpa(double temperature_k) noexcept;

/// Its derivative [hPa K^-1] where it is `saturated_hpa`; 0 where it is clamped.
[[nodiscard]] double saturation_slope_hpa_k(double temperature_k, double saturated_hpa) noexcept;

/// Mass of vapour per mass of air: 0.622 e / p.
[[nodiscard]] double specific_humidity(double vapour_hpa, double pressure_hpa) noexcept;

inline constexpr double kHeatOfAirJKgK = 1005;      ///< specific heat of air at constant pressure
inline constexpr double kVaporisationJKg = 2.47e6;  ///< latent heat of vaporisation of water at 13 deg C
inline constexpr double kStefanBoltzmann = 5.670374419e-8;  ///< [W m^-2 K^-4], exact SI

/// Radiation of a blackbody over all wavelengths [W m^-2].
[[nodiscard]] constexpr double blackbody_w_m2(double temperature_k) noexcept {
  const double square = temperature_k * temperature_k;
  return kStefanBoltzmann * square * square;
}

}  // namespace thermal
