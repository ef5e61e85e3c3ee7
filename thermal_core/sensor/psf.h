#pragma once

#include "radiometry/spectral_response.h"
#include "sensor/convolution.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Modulation transfer of an ideal lens with a round, unobstructed aperture in incoherent light of one wavelength:
/// 2/pi (acos v - v sqrt(1 - v^2)), v = frequency * wavelength * f-number; 0 beyond v = 1 (Goodman, Introduction
/// to Fourier Optics, 6.32). Requires frequency >= 0.
[[nodiscard]] double diffraction_mtf(double cycles_per_mm, double wavelength_um, double f_number) noexcept;

/// Modulation transfer along rows or columns, from the scene to the pixels' signal, at a frequency in cycles per
/// pixel (0.5: Nyquist). gaussian: exp(-2 pi^2 sigma^2 f^2). physical: diffraction, averaged over the band weighted
/// by the radiance at 300 K; times sinc(f) for a square pixel with 100 % fill factor; times a Gaussian.
[[nodiscard]] double optics_mtf(const OpticsParameters& optics, const SpectralResponse& response,
                                double cycles_per_px);

/// The discrete kernel whose modulation transfer is optics_mtf(). `supersample`: the picture already holds the means
/// of this many samples across a pixel, whose part of the footprint is left out.
/// From sigma = 1 px up a sampled Gaussian, accurate to 0.0072 up to Nyquist. Otherwise least squares over all
/// frequencies up to Nyquist with H(0) = 1, within 0.015 along rows and columns for lenses up to f/2 at 12 um (a
/// transfer with a corner at 0 and another at Nyquist takes many taps; at f/3 it is 0.022). The physical transfer of
/// a round lens is not separable into rows and columns: along diagonals the kernel is softer by up to 0.07 (`veldt
/// bench --suite sensor`).
[[nodiscard]] HalfKernel psf_kernel(const OpticsParameters& optics, const SpectralResponse& response,
                                    int supersample);

/// Modulation transfer of a kernel.
[[nodiscard]] double kernel_mtf(const HalfKernel& kernel, double cycles_per_px) noexcept;

}  // namespace thermal
