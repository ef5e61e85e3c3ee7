#pragma once

#include <cstddef>
#include <vector>

#include "base/image.h"
#include "radiometry/spectral_response.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Differences between the quarters of each pixel [W m^-2 sr^-1]. With the pixel's mean m, its quarters are, from the
/// top left to the bottom right, m - across - down + crossed, m + across - down - crossed, m - across + down - crossed
/// and m + across + down + crossed. 0 where a pixel has one value. Empty planes: no subpixel data.
struct SubpixelDetail {
  Plane<float> across;
  Plane<float> down;
  Plane<float> crossed;

  [[nodiscard]] bool empty() const noexcept { return across.empty(); }
};

/// Weights of a square kernel at offsets 0, 1, …, radius to the right and down; those at other offsets follow by
/// symmetry.
struct QuadrantKernel {
  int radius = 0;
  std::vector<float> weights;  ///< [radius + 1][radius + 1], row by row

  [[nodiscard]] float at(int right, int down) const noexcept {
    return weights[static_cast<std::size_t>(down * (radius + 1) + right)];
  }
};

/// How the scene is sampled.
struct PixelSampling {
  int across = 1;  ///< samples whose mean is a pixel's radiance, along each side
  bool quarters =
      false;  ///< the means of a pixel's quarters are known too (SubpixelDetail); `across` is even

  [[nodiscard]] bool operator==(const PixelSampling&) const = default;
};

/// The point spread of a lens with a round aperture in front of square pixels, as sums over a picture:
///   `pixel` over the pixels around one, symmetric both ways;
///   `across` over their SubpixelDetail::across, odd to the right and even down; transposed, over `down`;
///   `crossed` over their SubpixelDetail::crossed, odd both ways;
///   `halo` over means of kHaloBlockPx x kHaloBlockPx pixels, interpolated linearly between their middles: the far
///   tail of a round aperture.
/// All weights of pixels, quarters and blocks are at least 0, and those of `pixel` and `halo` sum to 1 within 6e-8: no
/// result is below the coldest or above the warmest part of the scene.
struct RoundKernel {
  QuadrantKernel pixel;
  QuadrantKernel across;
  QuadrantKernel crossed;
  QuadrantKernel halo;
};

/// Side of the blocks of pixels that the wide halo is made of.
inline constexpr int kHaloBlockPx = 4;

/// Finds the weights by least squares over all two-dimensional frequencies f that they resolve, up to 1 cycle per pixel
/// along each axis with quarters and up to 1/2 without: the least sum over f of P(f) (K(f) S(f) - M(f))^2. M is the
/// transfer from scene to signal (optics_mtf()), S that of the samples' mean, K that of the weights; P ~ |f|^-2, as
/// spectra of scenes. The radius grows until the transfer is within 0.01 up to Nyquist in all directions, or hardly
/// improves.
///
/// With quarters the transfer is within 0.01 (round_kernel_test.cpp has the errors). Without, it is within 0.06: up to
/// Nyquist of whole pixels, M falls to 0 at no frequency, and weights of at least 0 follow it less well.
[[nodiscard]] RoundKernel round_kernel(const OpticsParameters& optics, const SpectralResponse& response,
                                       const PixelSampling& sampling);

/// Transfer from the scene to the pixels' signal by a kernel, at a frequency in cycles per pixel, samples included.
[[nodiscard]] double sampled_mtf(const RoundKernel& kernel, const PixelSampling& sampling,
                                 double across_cycles_per_px, double down_cycles_per_px) noexcept;

}  // namespace thermal
