#pragma once

namespace thermal {

/// Air temperatures that are accepted [K]: -40 to 50 deg C. Beyond, the vapour pressure's fit ends (-45 to 60 deg C),
/// and the sky's was not measured; Table 1's temperatures are straight lines through 273 K and 293 K of air,
/// extrapolated. Humid air ends sooner: above 25 g m^-3 of water (310 K and 60 %, 300 K and 100 %) the path stays
/// what it is there, and a sky is never more than a blackbody (from 312 K and 60 %, 300 K and 100 %).
inline constexpr double kColdestAirK = 233;
/// The warmest that is accepted [K]: see kColdestAirK.
inline constexpr double kHottestAirK = 323;

/// The largest inversion that is accepted [K]: the camera's radiance of air is taken to change linearly along the
/// path.
inline constexpr double kLargestInversionK = 20;

/// The state of the air near the ground. The functions below are figures as published, each for one band; BandAir
/// spreads them over the spectrum.
struct Air {
  double temperature_k = 293;
  double relative_humidity = 0.7;  ///< 0 to 1
  double cloud_fraction = 0;       ///< 0 clear to 1 overcast
  double inversion_k = 0;  ///< how much warmer the air is at the camera, see BandAir::mean_path_absorption()

  /// ConfigError unless from kColdestAirK to kHottestAirK, the inversion from 0 to kLargestInversionK, and the others
  /// from 0 to 1.
  void validate() const;

  [[nodiscard]] bool operator==(const Air&) const = default;
};

/// Partial pressure of water vapour [hPa]; Magnus form, 17.62 and 243.12 C (WMO-No. 8, 2018), over water.
[[nodiscard]] double vapour_pressure_hpa(const Air& air) noexcept;

/// Water content of the air as the path model below wants it [g m^-3]; clamped to at most 25, its range.
[[nodiscard]] double path_water_g_m3(const Air& air) noexcept;

/// In-band (7.5-14 um) transmittance of a level path in the form FLIR publishes (after Passman and Larmore;
/// coefficients as in Tran et al., Sensors 17, 2017). Within .017 of line-by-line figures at 100 m.
/// The fit's square root has an infinite slope at 0 and would make 5 m of air look like 30; below 30 m Beer's
/// law through its value there takes over. The range is clamped to [0, 1000] m and the result to [0, 1], beyond
/// which the fit turns unphysical. NaN and infinity count as 1000 m.
[[nodiscard]] double path_transmittance(const Air& air, double range_m) noexcept;

/// Emissivity of a clear sky at the zenith in 8-14 um: 0.24 + 2.98e-8 e^2 exp(3000 / T), e in hPa, at most 1
/// (Idso, Water Resour. Res. 17, 295, 1981).
[[nodiscard]] double clear_zenith_emissivity(const Air& air) noexcept;

/// The same averaged over the hemisphere as a diffuse surface sees it: e_z (1.4 - 0.4 e_z) (Kimball, Idso and
/// Aase, Water Resour. Res. 18, 931, 1982).
[[nodiscard]] double clear_sky_emissivity(const Air& air) noexcept;

}  // namespace thermal
