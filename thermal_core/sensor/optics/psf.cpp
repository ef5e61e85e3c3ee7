#include "sensor/optics/psf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "radiometry/planck.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kSpectrumTemperatureK = 300;
constexpr int kWavelengths = 96;         // midpoints; twice as many change no transfer by 1e-5
constexpr double kHighestOfTable = 4.4;  // cycles per pixel
constexpr int kFrequencies = 512;        // midpoints from 0 to Nyquist
constexpr double kLargestMisfit = 0.015;
constexpr int kLargestRadius = 15;

double gaussian_mtf(double cycles_per_px, double sigma_px) {
  const double phase = pi * sigma_px * cycles_per_px;
  return std::exp(-2 * phase * phase);
}

/// Transfer of a square pixel as wide as the pitch.
double footprint_mtf(double cycles_per_px) {
  const double x = pi * cycles_per_px;
  return std::abs(x) < 1e-6 ? 1 : std::sin(x) / x;
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
    sum += weight * diffraction_mtf(cycles_per_mm, wavelength_um, optics.f_number, optics.defocus_um);
    weights += weight;
  }
  return sum / weights;
}

/// Transfer of the round parts: lens and Gaussian.
double lens_mtf(const OpticsParameters& optics, const SpectralResponse& response, double cycles_per_px) {
  if (optics.psf == Psf::gaussian) return gaussian_mtf(cycles_per_px, optics.blur_sigma_px);
  return band_diffraction_mtf(optics, response, cycles_per_px) *
         gaussian_mtf(cycles_per_px, optics.aberration_sigma_px);
}

/// Overlap of two discs of radius 1 whose centres are 2 v apart, weighted by cos(phase x) with x along the line between
/// the centres, as a share of a disc. With y = sin(angle) the integrand is smooth, and midpoints converge fast.
double defocused_overlap(double v, double phase) {
  const double top = std::sqrt(1 - v * v);
  const int points = 64 + static_cast<int>(4 * phase);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double angle = pi * ((i + 0.5) / points - 0.5);
    const double y = top * std::sin(angle);
    const double half_width = std::sqrt(1 - y * y) - v;
    sum += std::cos(angle) * std::sin(phase * half_width) / phase;
  }
  return 2 * top * sum / points;
}

/// Least squares over all frequencies is the Fourier series; to make H(0) = 1, the remainder is distributed equally
/// over all taps, which gives the nearest such kernel.
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

/// The smallest kernel whose transfer fits a Gaussian's.
HalfKernel fitted_gaussian(double sigma_px) {
  std::vector<double> transfer;
  for (int k = 0; k < kFrequencies; ++k)
    transfer.push_back(gaussian_mtf(0.5 * (k + 0.5) / kFrequencies, sigma_px));
  HalfKernel kernel;
  for (int radius = 1; radius <= kLargestRadius;
       radius += 2) {  // even ones fit hardly better than the odd one below
    kernel = rounded_kernel(fit_kernel(transfer, radius));
    if (worst_misfit(kernel, transfer) <= kLargestMisfit) break;
  }
  return kernel;
}

}  // namespace

double diffraction_mtf(double cycles_per_mm, double wavelength_um, double f_number,
                       double defocus_um) noexcept {
  constexpr double kLeastPhase = 1e-4;
  const double v = 1e-3 * cycles_per_mm * wavelength_um * f_number;
  if (v >= 1) return 0;
  const double edge_um = std::abs(defocus_um) / (8 * f_number * f_number);
  const double phase = 8 * pi * edge_um * v / wavelength_um;
  if (phase > kLeastPhase) return defocused_overlap(v, phase);
  return 2 / pi * (std::acos(v) - v * std::sqrt(1 - v * v));
}

double optics_mtf(const OpticsParameters& optics, const SpectralResponse& response, double cycles_per_px) {
  const double lens = lens_mtf(optics, response, cycles_per_px);
  return optics.psf == Psf::gaussian ? lens : lens * footprint_mtf(cycles_per_px);
}

OpticsTransfer::OpticsTransfer(const OpticsParameters& optics, const SpectralResponse& response)
    : has_footprint_(optics.psf == Psf::physical) {
  constexpr int kSteps = 1024;
  per_step_ = kSteps / kHighestOfTable;
  for (int step = 0; step <= kSteps; ++step) round_.push_back(lens_mtf(optics, response, step / per_step_));
}

double OpticsTransfer::at(double across_cycles_per_px, double down_cycles_per_px) const noexcept {
  const double step = per_step_ * std::hypot(across_cycles_per_px, down_cycles_per_px);
  const auto below = static_cast<std::size_t>(step);
  if (below + 1 >= round_.size()) return 0;
  const double share = step - static_cast<double>(below);
  const double lens = (1 - share) * round_[below] + share * round_[below + 1];
  return has_footprint_ ? lens * footprint_mtf(across_cycles_per_px) * footprint_mtf(down_cycles_per_px)
                        : lens;
}

HalfKernel gaussian_psf(double sigma_px) {
  // A sampled Gaussian narrower than this has aliases; 0 needs no fit.
  constexpr double kSampledWellPx = 1;
  return sigma_px == 0 || sigma_px >= kSampledWellPx ? gaussian_kernel(sigma_px) : fitted_gaussian(sigma_px);
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
