#include "sensor/psf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "radiometry/planck.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kSpectrumTemperatureK = 300;
constexpr int kWavelengths = 96;   // midpoints; twice as many change no transfer by 1e-5
constexpr int kFrequencies = 512;  // midpoints from 0 to Nyquist
constexpr double kLargestMisfit = 0.015;
constexpr int kLargestRadius = 15;

double gaussian_mtf(double cycles_per_px, double sigma_px) {
  const double phase = pi * sigma_px * cycles_per_px;
  return std::exp(-2 * phase * phase);
}

/// Of a square pixel as wide as the pitch.
double footprint_mtf(double cycles_per_px) {
  const double x = pi * cycles_per_px;
  return std::abs(x) < 1e-6 ? 1 : std::sin(x) / x;
}

/// Of the mean of `count` samples evenly spread over a pixel.
double sampled_footprint_mtf(double cycles_per_px, int count) {
  const double x = pi * cycles_per_px / count;
  return std::abs(x) < 1e-6 ? 1 : std::sin(count * x) / (count * std::sin(x));
}

double band_diffraction_mtf(const OpticsParameters& optics, const SpectralResponse& response,
                            double cycles_per_px) {
  const double cycles_per_mm = 1e3 * cycles_per_px / optics.pixel_pitch_um;
  const double step_um = (response.end_um() - response.begin_um()) / kWavelengths;
  double sum = 0;
  double weights = 0;
  for (int i = 0; i < kWavelengths; ++i) {
    const double wavelength_um = response.begin_um() + (i + 0.5) * step_um;
    const double weight = response.at(wavelength_um) * planck_radiance(wavelength_um, kSpectrumTemperatureK);
    sum += weight * diffraction_mtf(cycles_per_mm, wavelength_um, optics.f_number);
    weights += weight;
  }
  return sum / weights;
}

/// Least squares over all frequencies is the Fourier series; to make H(0) = 1, the remainder is shared equally by all
/// taps, which is the nearest such kernel.
std::vector<double> fit_kernel(const std::vector<double>& transfer, int radius) {
  std::vector<double> half(static_cast<std::size_t>(radius) + 1, 0);
  const auto count = static_cast<double>(transfer.size());
  double sum = 0;
  for (int tap = 0; tap <= radius; ++tap) {
    double& weight = half[static_cast<std::size_t>(tap)];
    for (std::size_t k = 0; k < transfer.size(); ++k) {
      weight += transfer[k] * std::cos(pi * tap * (static_cast<double>(k) + 0.5) / count) / count;
    }
    sum += (tap == 0 ? 1 : 2) * weight;
  }
  for (double& weight : half) weight += (1 - sum) / (2 * radius + 1);
  return half;
}

double worst_misfit(const HalfKernel& kernel, const std::vector<double>& transfer) {
  double worst = 0;
  for (std::size_t k = 0; k < transfer.size(); ++k) {
    const double cycles_per_px = 0.5 * (static_cast<double>(k) + 0.5) / static_cast<double>(transfer.size());
    worst = std::max(worst, std::abs(kernel_mtf(kernel, cycles_per_px) - transfer[k]));
  }
  return worst;
}

/// The smallest kernel whose transfer fits optics_mtf(), divided by that of `supersample` samples per pixel.
HalfKernel fitted_kernel(const OpticsParameters& optics, const SpectralResponse& response, int supersample) {
  std::vector<double> transfer;
  for (int k = 0; k < kFrequencies; ++k) {
    const double cycles_per_px = 0.5 * (k + 0.5) / kFrequencies;
    transfer.push_back(optics_mtf(optics, response, cycles_per_px) /
                       sampled_footprint_mtf(cycles_per_px, supersample));
  }
  HalfKernel kernel;
  for (int radius = 1; radius <= kLargestRadius;
       radius += 2) {  // even ones fit hardly better than the odd one below
    kernel = rounded_kernel(fit_kernel(transfer, radius));
    if (worst_misfit(kernel, transfer) <= kLargestMisfit) break;
  }
  return kernel;
}

}  // namespace

double diffraction_mtf(double cycles_per_mm, double wavelength_um, double f_number) noexcept {
  const double v = 1e-3 * cycles_per_mm * wavelength_um * f_number;
  return v >= 1 ? 0 : 2 / pi * (std::acos(v) - v * std::sqrt(1 - v * v));
}

double optics_mtf(const OpticsParameters& optics, const SpectralResponse& response, double cycles_per_px) {
  if (optics.psf == Psf::gaussian) return gaussian_mtf(cycles_per_px, optics.blur_sigma_px);
  return band_diffraction_mtf(optics, response, cycles_per_px) * footprint_mtf(cycles_per_px) *
         gaussian_mtf(cycles_per_px, optics.aberration_sigma_px);
}

HalfKernel psf_kernel(const OpticsParameters& optics, const SpectralResponse& response, int supersample) {
  assert(supersample >= 1);
  if (optics.psf == Psf::physical) return fitted_kernel(optics, response, supersample);
  // Samples of a Gaussian narrower than this have aliases; with 0 there is nothing to fit.
  constexpr double kSampledWellPx = 1;
  const double sigma_px = optics.blur_sigma_px;
  return sigma_px == 0 || sigma_px >= kSampledWellPx ? gaussian_kernel(sigma_px)
                                                     : fitted_kernel(optics, response, 1);
}

double kernel_mtf(const HalfKernel& kernel, double cycles_per_px) noexcept {
  double transfer = static_cast<double>(kernel[0]);
  for (std::size_t tap = 1; tap < kernel.size(); ++tap) {
    transfer +=
        2 * static_cast<double>(kernel[tap]) * std::cos(2 * pi * static_cast<double>(tap) * cycles_per_px);
  }
  return transfer;
}

}  // namespace thermal
