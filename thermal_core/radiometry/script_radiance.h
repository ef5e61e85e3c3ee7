#pragma once

namespace thermal {

/// In-band radiance [W m^-2 sr^-1], 8-14 um, as the script published with AirSim-W computes it: Planck at 8.00,
/// 8.01 … 13.99 um with c1 = 1.19104e8 W um^4 m^-2 sr^-1 and c2 = 1.43879e4 um K, trapezoid, no response.
/// Kept to reproduce that script's frames (Bondi et al., COMPASS 2018); 1.4e-3 below the true value at 300 K
/// (-92 mK), mostly the missing last 0.01 um. Not for any other use.
/// @param temperature_k  > 0; <= 0 returns 0; NaN returns NaN
[[nodiscard]] double script_radiance(double temperature_k) noexcept;

}  // namespace thermal
