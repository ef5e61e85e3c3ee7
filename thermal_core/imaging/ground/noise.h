#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/ground_maps.h"
#include "scene/manifest.h"

namespace thermal {

/// A rectangle of the cells of ground maps: [first, first + count) along x and y.
struct GroundWindow {
  std::size_t first_x = 0;
  std::size_t first_y = 0;
  std::size_t width = 0;
  std::size_t height = 0;

  [[nodiscard]] bool operator==(const GroundWindow&) const = default;
};

/// The cells that a clip may show, with a margin for interpolation: at least one cell; all cells if a frame has no pose
/// or shows the horizon.
[[nodiscard]] GroundWindow window_of(const GroundMaps& maps, const Manifest& manifest);

/// Wavelength of the finest octave.
inline constexpr double kFinestNoiseCells = 2;

/// Roughness of bare ground: its power falls with frequency to the power of -2.2, as in night frames of HIT-UAV from 10
/// to 1.2 m (Suo et al. 2023; scales that their optics resolve).
inline constexpr double kGroundRoughness = 0.93;

/// The octaves of a noise.
struct NoiseOctaves {
  double length_cells = 0;  ///< correlation length, > 0; below kFinestNoiseCells all values are 0
  double roughness = 0.6;   ///< amplitude of an octave relative to the next coarser one
  double finest_cells = kFinestNoiseCells;  ///< wavelength of the finest octave
};

/// Fractal noise over the cells of a window: mean 0, variance 1, never repeated. It sums octaves of smooth noise from
/// the correlation length down to the finest. Octaves below kFinestNoiseCells are left out together with their
/// variance, so that coarse cells have the coarse part of the noise of fine ones. A cell's value depends on (seed,
/// stream, cell) alone, whatever the window. Values are [row of y, column of x].
[[nodiscard]] std::vector<float> ground_noise(const GroundWindow& window, const NoiseOctaves& octaves,
                                              std::uint32_t seed, std::uint32_t stream);

}  // namespace thermal
