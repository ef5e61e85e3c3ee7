#pragma once

namespace thermal {

/// First radiation constant for radiance, 2 h c^2 [W m^2 sr^-1].
/// Exact SI 2019 values of h, c, k (Tiesinga et al., Rev. Mod. Phys. 93, 025010, 2021).
inline constexpr double kFirstRadiationConstant = 1.191042972397188414e-16;
/// Second radiation constant, h c / k [m K]; from the same values.
inline constexpr double kSecondRadiationConstant = 0.01438776877503933802;

/// Spectral radiance of a blackbody [W m^-2 sr^-1 um^-1].
/// Planck's law. expm1 keeps a small exponent accurate; past exp's range the value is 0.
/// @param wavelength_um  vacuum wavelength, > 0
/// @param temperature_k  kinetic temperature; <= 0 returns 0; NaN returns NaN; infinity returns infinity
/// Relative error <= (3x + 5) eps, x = c2 / (wavelength * temperature).
[[nodiscard]] double planck_radiance(double wavelength_um, double temperature_k) noexcept;

/// In-band radiance [W m^-2 sr^-1], 8-14 um, as the script published with AirSim-W computes it: Planck at 8.00,
/// 8.01 … 13.99 um with c1 = 1.19104e8 W um^4 m^-2 sr^-1 and c2 = 1.43879e4 um K, trapezoid, no response.
/// Kept to reproduce that script's frames (Bondi et al., COMPASS 2018); 1.4e-3 below the true value at 300 K
/// (-92 mK), mostly the missing last 0.01 um. Not for any other use.
/// @param temperature_k  > 0; <= 0 returns 0; NaN returns NaN
[[nodiscard]] double script_radiance(double temperature_k) noexcept;

}  // namespace thermal
