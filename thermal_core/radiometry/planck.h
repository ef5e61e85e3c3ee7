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

}  // namespace thermal
