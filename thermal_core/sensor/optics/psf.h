#pragma once

#include <vector>

#include "radiometry/spectral_response.h"
#include "sensor/optics/convolution.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Modulation transfer of an ideal lens with a round, unobstructed aperture in incoherent light of one wavelength.
/// In focus: 2/pi (acos v - v sqrt(1 - v^2)), v = frequency * wavelength * f-number; 0 beyond v = 1 (Goodman,
/// Introduction to Fourier Optics, 6.32). With the detector `defocus_um` out of focus, the aperture's edge is out of
/// phase by W = defocus / (8 F^2), and the overlap of the two apertures is weighted by the cosine of the difference in
/// phase (Hopkins, Proc. R. Soc. A 231, 1955); the transfer may then be negative. Frequency >= 0. Error below 1e-6.
[[nodiscard]] double diffraction_mtf(double cycles_per_mm, double wavelength_um, double f_number,
                                     double defocus_um = 0) noexcept;

/// Modulation transfer along rows or columns, from the scene to the pixels' signal, at a frequency in cycles per
/// pixel (0.5: Nyquist). gaussian: exp(-2 pi^2 sigma^2 f^2). physical: diffraction, averaged over the band weighted
/// by the radiance at 300 K; times sinc(f) for a square pixel with 100 % fill factor; times a Gaussian.
[[nodiscard]] double optics_mtf(const OpticsParameters& optics, const SpectralResponse& response,
                                double cycles_per_px);

/// The same at any two-dimensional frequency, fast: the round parts are tabulated. Within 2e-5 of optics_mtf(), up to
/// 4.4 cycles per pixel; 0 beyond.
class OpticsTransfer {
 public:
  OpticsTransfer(const OpticsParameters& optics, const SpectralResponse& response);

  [[nodiscard]] double at(double across_cycles_per_px, double down_cycles_per_px) const noexcept;

 private:
  bool has_footprint_;
  double per_step_;            ///< steps of the table per cycle per pixel
  std::vector<double> round_;  ///< of the lens alone
};

/// The discrete kernel of a plain Gaussian, along rows or columns. From sigma = 1 px up a sampled Gaussian, accurate to
/// 0.0072 up to Nyquist. Otherwise least squares over all frequencies up to Nyquist with H(0) = 1, within 0.015.
[[nodiscard]] HalfKernel gaussian_psf(double sigma_px);

/// Modulation transfer of a kernel.
[[nodiscard]] double kernel_mtf(const HalfKernel& kernel, double cycles_per_px) noexcept;

}  // namespace thermal
