#pragma once

#include <cstdint>
#include <vector>

#include "imaging/ground_window.h"

namespace thermal {

/// Wavelength of the finest octave.
inline constexpr double kFinestNoiseCells = 2;

/// Of the fabric of the ground: a power that falls by 2.2 of the frequency, as that of night frames of HIT-UAV does from 10
/// to 1.2 m (Suo et al. 2023; where their optics do not matter yet).
inline constexpr double kGroundRoughness = 0.93;

/// The octaves of a noise.
struct NoiseOctaves {
  double length_cells =
      0;  ///< correlation length, > 0; below kFinestNoiseCells nothing is left, and all values are 0
  double roughness = 0.6;                   ///< how strong an octave is against the one before
  double finest_cells = kFinestNoiseCells;  ///< where they end
};

/// Fractal noise over the cells of a window: mean 0, variance 1, never repeated. It sums octaves of smooth noise from
/// the correlation length down to the finest. Those below kFinestNoiseCells are left out, and the variance is less by
/// theirs, so that coarse cells have what is wide in the noise of fine ones. A cell's value depends on (seed, stream, cell) alone, whatever the window.
/// Values are [row of y, column of x].
[[nodiscard]] std::vector<float> ground_noise(const GroundWindow& window, const NoiseOctaves& octaves,
                                              std::uint32_t seed, std::uint32_t stream);

}  // namespace thermal
