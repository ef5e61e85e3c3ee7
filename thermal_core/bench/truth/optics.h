#pragma once

#include <cstddef>
#include <vector>

namespace thermal {

/// A surface that emits like a blackbody times an emissivity.
struct GreySurface {
  double temperature_k = 300;
  double emissivity = 1;
};

/// Camera parameters of the truth. The response is 1 within the band.
struct TruthCamera {
  double begin_um = 7.5;
  double end_um = 13.5;
  double f_number = 1.25;
  double pitch_um = 17;
  double aberration_sigma_px = 0.25;  ///< of a Gaussian, >= 0.1; behind the lens, before the pixel's square
  double gaussian_sigma_px = 0;       ///< above 0: this Gaussian is all optics, as in the published model
  double focal_length_px = 764.7;
  double time_constant_s = 0.01;  ///< of a pixel; 0: none
};

/// Step sizes of the truth; its error falls with each of them.
struct TruthSteps {
  int lines_per_px = 32;   ///< rows of rays across a pixel; along a row, edges are exact
  int cells_per_px = 16;   ///< of the tabulated response to a line, between which it is cubic
  int wavelengths = 192;   ///< midpoints over the band
  int times_per_cell = 8;  ///< steps in time while an image moves by a cell
  int radius_px = 48;      ///< light beyond this distance is dropped
};

/// Planck's law integrated over the band [W m^-2 sr^-1], by Simpson's rule with 120 steps: relative error below 1e-7 (7
/// uK) of 200 to 2000 K within 7.5 to 14 um. Constants: exact SI.
[[nodiscard]] double truth_band_radiance(double begin_um, double end_um, double temperature_k);

/// Temperature of the blackbody with a band radiance, by Newton's method; within 1e-6 K.
[[nodiscard]] double truth_temperature_k(const TruthCamera& camera, double radiance_w_m2_sr);

/// Image of a point through an ideal lens with a round aperture, at a distance from its centre, per px^2: the Airy
/// pattern, whose integral over the plane is 1 (Goodman, Introduction to Fourier Optics, 4.4.2).
[[nodiscard]] double airy_per_px2(const TruthCamera& camera, double wavelength_um, double radius_px) noexcept;

/// The signal of a pixel for a line of a target in front of ground. Each wavelength has its own image, weighted by the
/// difference of both surfaces' radiance; convolved with the Gaussian of aberration and the pixel's square. Sums over
/// all offsets are direct.
class ContrastKernel {
 public:
  /// @param spectrum_k  if above 0, images of all wavelengths are weighted as for a blackbody of this temperature, as
  /// in the shipped optics: to measure that approximation
  ContrastKernel(const TruthCamera& camera, const GreySurface& target, const GreySurface& ground,
                 const TruthSteps& steps, double spectrum_k = 0);

  /// The kernel of a pixel with a thermal time constant, for a target that moves towards -x: along x, each value
  /// becomes the mean over the past, weighted by exp(-age / time constant). `smear_px` is how far the target moves in
  /// one time constant. 0: the same kernel.
  [[nodiscard]] ContrastKernel smeared(double smear_px) const;

  /// Integral of the pixel's response over targets to the left of `x_px`, on a line `line` + 1/2 lines from the pixel's
  /// centre (negative: above): W m^-2 sr^-1 per px of height. Offsets are of the pixel relative to the target.
  [[nodiscard]] double up_to(double x_px, int line) const noexcept;

  [[nodiscard]] const TruthSteps& steps() const noexcept { return steps_; }
  [[nodiscard]] double contrast_w_m2_sr() const noexcept { return contrast_w_m2_sr_; }

 private:
  [[nodiscard]] const double* row(std::size_t line) const noexcept { return &sums_[line * columns_]; }

  TruthSteps steps_;
  double contrast_w_m2_sr_ = 0;  ///< target - ground
  std::size_t columns_ = 0;
  std::vector<double>
      sums_;  ///< [radius * lines][columns]: running integrals along x, from -radius to radius
};

}  // namespace thermal
