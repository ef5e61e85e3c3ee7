#include "bench/truth/optics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace thermal {
namespace {

using std::numbers::pi;

constexpr int kTruthRadiiPerPx = 128;  // of tabulated Airy patterns, whose rings are 0.6 px apart or more
constexpr double kGaussianReach = 5.5;

/// W m^-2 sr^-1 um^-1.
double truth_planck(double wavelength_um, double temperature_k) {
  constexpr double kC1 = 1.191042972397188414e8;  // 2 h c^2 [W um^4 m^-2 sr^-1]
  constexpr double kC2 = 14387.76877503933802;    // h c / k [um K]
  return kC1 / (std::pow(wavelength_um, 5) * std::expm1(kC2 / (wavelength_um * temperature_k)));
}

/// Radiance of each wavelength node; they sum to the band radiance.
std::vector<double> emitted_by_wavelength(const TruthCamera& camera, const GreySurface& surface, int count) {
  std::vector<double> emitted;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double wavelength_um = camera.begin_um + (camera.end_um - camera.begin_um) * (i + 0.5) / count;
    emitted.push_back(truth_planck(wavelength_um, surface.temperature_k));
    sum += emitted.back();
  }
  const double whole =
      surface.emissivity * truth_band_radiance(camera.begin_um, camera.end_um, surface.temperature_k);
  for (double& value : emitted) value *= whole / sum;
  return emitted;
}

/// The image of a point by radius, kTruthRadiiPerPx to a pixel.
std::vector<double> lens_by_radius(const TruthCamera& camera, const std::vector<double>& weights,
                                   double reach_px) {
  const auto radii = static_cast<std::size_t>(std::ceil(1.4143 * reach_px * kTruthRadiiPerPx)) + 2;
  std::vector<double> table(radii, 0);
  const auto count = static_cast<double>(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double wavelength_um =
        camera.begin_um + (camera.end_um - camera.begin_um) * (static_cast<double>(i) + 0.5) / count;
    for (std::size_t r = 0; r < radii; ++r) {
      table[r] += weights[i] * airy_per_px2(camera, wavelength_um, static_cast<double>(r) / kTruthRadiiPerPx);
    }
  }
  return table;
}

/// Response of a pixel's square, or of a plain Gaussian, to light at a distance along one axis, per px.
double detector_per_px(const TruthCamera& camera, double x_px) {
  if (camera.gaussian_sigma_px > 0) {
    const double x = x_px / camera.gaussian_sigma_px;
    return std::exp(-0.5 * x * x) / (camera.gaussian_sigma_px * std::sqrt(2 * pi));
  }
  const double scale = 1 / (std::numbers::sqrt2 * camera.aberration_sigma_px);
  return 0.5 * (std::erf((x_px + 0.5) * scale) - std::erf((x_px - 0.5) * scale));
}

/// A plane of the quadrant of offsets to the right and below. Columns are at multiples of a cell, rows between lines.
struct Quadrant {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;
  [[nodiscard]] const double* row(std::size_t y) const { return &values[y * columns]; }
  [[nodiscard]] double* row(std::size_t y) { return &values[y * columns]; }
};

Quadrant quadrant_of(std::size_t rows, std::size_t columns) {
  return {rows, columns, std::vector<double>(rows * columns)};
}

Quadrant lens_image(const std::vector<double>& by_radius, const TruthSteps& steps, std::size_t rows,
                    std::size_t columns) {
  Quadrant image = quadrant_of(rows, columns);
  for (std::size_t y = 0; y < rows; ++y) {
    const double dy = (static_cast<double>(y) + 0.5) / steps.lines_per_px;
    for (std::size_t x = 0; x < columns; ++x) {
      const double position = kTruthRadiiPerPx * std::hypot(static_cast<double>(x) / steps.cells_per_px, dy);
      const double floor = std::floor(position);
      const auto at = std::min(static_cast<std::size_t>(floor), by_radius.size() - 2);
      const double share = std::min(1.0, position - floor);
      image.row(y)[x] = (1 - share) * by_radius[at] + share * by_radius[at + 1];
    }
  }
  return image;
}

/// Weights of the detector at multiples of a step.
std::vector<double> detector_weights(const TruthCamera& camera, int per_px) {
  const double sigma = std::max(camera.gaussian_sigma_px, camera.aberration_sigma_px);
  const double half_px = (camera.gaussian_sigma_px > 0 ? 0 : 0.5) + kGaussianReach * sigma;
  std::vector<double> weights;
  for (int i = 0; i <= half_px * per_px; ++i)
    weights.push_back(detector_per_px(camera, static_cast<double>(i) / per_px) / per_px);
  return weights;
}

/// Sums across rows, which are symmetric about the edge between rows -1 and 0.
Quadrant summed_down(const Quadrant& in, const std::vector<double>& weights, std::size_t rows) {
  Quadrant out = quadrant_of(rows, in.columns);
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(y) + k;
      const double* source = in.row(static_cast<std::size_t>(from >= 0 ? from : -from - 1));
      const double weight = weights[static_cast<std::size_t>(std::abs(k))];
      for (std::size_t x = 0; x < in.columns; ++x) out.row(y)[x] += weight * source[x];
    }
  }
  return out;
}

/// Sums along a row, which is symmetric about column 0.
std::vector<double> summed_across(const double* in, const std::vector<double>& weights, std::size_t columns) {
  std::vector<double> out(columns, 0);
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  for (std::size_t x = 0; x < columns; ++x) {
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t from = std::abs(static_cast<std::ptrdiff_t>(x) + k);
      out[x] += weights[static_cast<std::size_t>(std::abs(k))] * in[from];
    }
  }
  return out;
}

/// Weights of four neighbouring values for cubic interpolation between the second and the third.
std::array<double, 4> cubic_weights(double t) noexcept {
  return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
          (t + 1) * t * (t - 1) / 6};
}

/// Running integrals from the left of a symmetric row given from its centre: cubic through four neighbours, cell by
/// cell.
void integrate_row(const std::vector<double>& half, double cell_px, double* sums, std::size_t columns) {
  const std::size_t middle = columns / 2;
  const auto value = [&](std::ptrdiff_t column) {
    const auto from_middle = static_cast<std::size_t>(std::abs(column - static_cast<std::ptrdiff_t>(middle)));
    return half[std::min(from_middle, half.size() - 1)];
  };
  sums[0] = 0;
  for (std::size_t x = 1; x < columns; ++x) {
    const auto at = static_cast<std::ptrdiff_t>(x);
    sums[x] = sums[x - 1] + cell_px / 24 * (13 * (value(at - 1) + value(at)) - value(at - 2) - value(at + 1));
  }
}

/// Contribution of a cell's four values to the mean over the past, when the image has moved by that cell.
std::array<double, 4> smear_weights(double cells_per_time_constant, int times) {
  std::array<double, 4> weights{};
  for (int i = 0; i < times; ++i) {
    const double begin = static_cast<double>(i) / times;
    const double end = static_cast<double>(i + 1) / times;
    const double share =
        std::exp(-(1 - end) / cells_per_time_constant) - std::exp(-(1 - begin) / cells_per_time_constant);
    const std::array<double, 4> cubic = cubic_weights(0.5 * (begin + end));
    for (std::size_t k = 0; k < 4; ++k) weights[k] += share * cubic[k];
  }
  return weights;
}

}  // namespace

double truth_band_radiance(double begin_um, double end_um, double temperature_k) {
  constexpr int kSteps = 120;
  const double step_um = (end_um - begin_um) / kSteps;
  double sum = truth_planck(begin_um, temperature_k) + truth_planck(end_um, temperature_k);
  for (int i = 1; i < kSteps; ++i)
    sum += (i % 2 == 1 ? 4 : 2) * truth_planck(begin_um + i * step_um, temperature_k);
  return sum * step_um / 3;
}

double truth_temperature_k(const TruthCamera& camera, double radiance_w_m2_sr) {
  double inverse = 1.0 / 300;  // ln L is nearly straight in 1 / T
  for (int i = 0; i < 50; ++i) {
    constexpr double kStep = 1e-5;
    const double here = std::log(truth_band_radiance(camera.begin_um, camera.end_um, 1 / inverse));
    const double there =
        std::log(truth_band_radiance(camera.begin_um, camera.end_um, 1 / (inverse * (1 + kStep))));
    const double change = (std::log(radiance_w_m2_sr) - here) * kStep * inverse / (there - here);
    inverse = std::max(inverse + change, 0.1 * inverse);
    if (std::abs(change) < 1e-12 * inverse) break;
  }
  return 1 / inverse;
}

double airy_per_px2(const TruthCamera& camera, double wavelength_um, double radius_px) noexcept {
  const double px_per_cycle = wavelength_um * camera.f_number / camera.pitch_um;
  const double v = pi * radius_px / px_per_cycle;
  const double amplitude = v < 1e-6 ? 1 : 2 * ::j1(v) / v;
  return pi / 4 * amplitude * amplitude / (px_per_cycle * px_per_cycle);
}

ContrastKernel::ContrastKernel(const TruthCamera& camera, const GreySurface& target,
                               const GreySurface& ground, const TruthSteps& steps, double spectrum_k)
    : steps_(steps) {
  std::vector<double> weights = emitted_by_wavelength(camera, target, steps.wavelengths);
  const std::vector<double> hidden = emitted_by_wavelength(camera, ground, steps.wavelengths);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] -= hidden[i];
  for (const double weight : weights) contrast_w_m2_sr_ += weight;
  if (spectrum_k > 0) {
    weights = emitted_by_wavelength(camera, {spectrum_k, 1}, steps.wavelengths);
    const double all = truth_band_radiance(camera.begin_um, camera.end_um, spectrum_k);
    for (double& weight : weights) weight *= contrast_w_m2_sr_ / all;
  }
  const std::vector<double> down = detector_weights(camera, steps.lines_per_px);
  const std::vector<double> across = detector_weights(camera, steps.cells_per_px);
  const auto radius = static_cast<std::size_t>(steps.radius_px);
  const std::size_t rows = radius * static_cast<std::size_t>(steps.lines_per_px);
  const std::size_t half = radius * static_cast<std::size_t>(steps.cells_per_px) + 1;
  columns_ = 2 * half - 1;
  sums_.resize(rows * columns_);
  Quadrant image;
  if (camera.gaussian_sigma_px == 0) {
    const double reach_px = steps.radius_px + static_cast<double>(down.size()) / steps.lines_per_px + 1;
    image = summed_down(lens_image(lens_by_radius(camera, weights, reach_px), steps, rows + down.size(),
                                   half + across.size()),
                        down, rows);
  }
  for (std::size_t y = 0; y < rows; ++y) {
    std::vector<double> values(half);
    if (camera.gaussian_sigma_px == 0) {
      values = summed_across(image.row(y), across, half);
    } else {
      const double dy = (static_cast<double>(y) + 0.5) / steps.lines_per_px;
      for (std::size_t x = 0; x < half; ++x) {
        values[x] = contrast_w_m2_sr_ * detector_per_px(camera, dy) *
                    detector_per_px(camera, static_cast<double>(x) / steps.cells_per_px);
      }
    }
    integrate_row(values, 1.0 / steps.cells_per_px, &sums_[y * columns_], columns_);
  }
}

ContrastKernel ContrastKernel::smeared(double smear_px) const {
  ContrastKernel out = *this;
  if (smear_px <= 0) return out;
  const double cells = smear_px * steps_.cells_per_px;
  const std::array<double, 4> weights = smear_weights(cells, steps_.times_per_cell);
  const double kept = std::exp(-1 / cells);
  const std::size_t last = columns_ - 1;
  const std::size_t rows = sums_.size() / columns_;
  for (std::size_t y = 0; y < rows; ++y) {
    const double* in = row(y);
    double* smeared = &out.sums_[y * columns_];
    for (std::size_t x = 1; x <= last; ++x) {  // before it, values are those of the left border
      smeared[x] = kept * smeared[x - 1] + weights[0] * in[x < 2 ? 0 : x - 2] + weights[1] * in[x - 1] +
                   weights[2] * in[x] + weights[3] * in[std::min(x + 1, last)];
    }
  }
  return out;
}

double ContrastKernel::up_to(double x_px, int line) const noexcept {
  const auto down = static_cast<std::size_t>(line >= 0 ? line : -line - 1);
  if (down >= sums_.size() / columns_) return 0;
  const double* sums = row(down);
  const double position = (x_px + steps_.radius_px) * steps_.cells_per_px;
  if (position <= 0) return 0;
  const std::size_t last = columns_ - 1;
  if (position >= static_cast<double>(last)) return sums[last];
  const auto at = static_cast<std::size_t>(position);
  const std::array<double, 4> cubic = cubic_weights(position - std::floor(position));
  return cubic[0] * sums[at == 0 ? 0 : at - 1] + cubic[1] * sums[at] + cubic[2] * sums[at + 1] +
         cubic[3] * sums[std::min(at + 2, last)];
}

}  // namespace thermal
