#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/image.h"

namespace thermal {

/// Edges of the bands of a frame's spectrum, cycles a pixel: octaves, and finer ones where cameras blur.
inline constexpr std::array kBandEdges = {0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.25, 0.35, 0.5};
/// Number of bands.
inline constexpr std::size_t kBands = kBandEdges.size() - 1;

/// Power spectrum of a frame by radial frequency.
struct RadialPower {
  std::array<double, kBands> bands{};  ///< mean over the frequencies of a band; 0 if it has none
  std::vector<double> curve;           ///< the same between curve_edges()
};

/// Edges of a finer curve for pictures: logarithmic, 0.004 to 0.5 cycles a pixel.
[[nodiscard]] const std::vector<double>& curve_edges();

/// Squared magnitude of the Fourier transform, not normalised, of the frame minus its mean under Hann's window
/// (symmetric), scaled by 640 x 512 px over the frame's pixels, so that white noise has the same power in frames of all
/// sizes.
[[nodiscard]] RadialPower radial_power(const Plane<float>& frame);

}  // namespace thermal
