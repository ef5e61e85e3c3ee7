#include "sensor/optics/round_kernel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/cholesky.h"
#include "sensor/optics/psf.h"

namespace thermal {
namespace {

using std::numbers::pi;

constexpr double kGoodMisfit = 0.01;
constexpr int kHaloRadius = 4;  // blocks
constexpr std::array kReachesPx = {2, 3, 4, 6, 9};

/// Frequencies along one axis with their widths, in cycles per pixel: denser where a transfer has its corner.
struct Frequencies {
  std::vector<double> at;
  std::vector<double> width;

  explicit Frequencies(double highest) {
    constexpr int kLow = 16;
    constexpr double kLowWidth = 1.0 / 128;
    constexpr double kWidth = 1.0 / 64;
    for (int i = 0; i < kLow; ++i) add((i + 0.5) * kLowWidth, kLowWidth);
    for (double from = kLow * kLowWidth; from < highest; from += kWidth) add(from + kWidth / 2, kWidth);
  }

 private:
  void add(double middle, double wide) {
    at.push_back(middle);
    width.push_back(wide);
  }
};

/// Weight of a frequency; flat below a fiftieth of a cycle per pixel.
double scene_power(double cycles_per_px) {
  constexpr double kFlatBelow = 0.02;
  return 1 / (kFlatBelow * kFlatBelow + cycles_per_px * cycles_per_px);
}

/// Transfer of the mean of samples evenly spread over `extent_px`.
double mean_transfer(double cycles_per_px, int samples, double extent_px) {
  const double x = pi * cycles_per_px * extent_px / samples;
  const double sine = std::sin(x);
  if (std::abs(sine) < 1e-9) return samples % 2 == 1 || std::cos(x) > 0 ? 1 : -1;
  return std::sin(samples * x) / (samples * sine);
}

/// Transfer of the samples that a weight of `core` applies to.
double sample_transfer(const PixelSampling& sampling, double cycles_per_px) {
  return sampling.quarters ? mean_transfer(cycles_per_px, sampling.across / 2, 0.5)
                           : mean_transfer(cycles_per_px, sampling.across, 1);
}

/// Transfer of a pixel's mean, relative to that of the samples.
double pixel_transfer(const PixelSampling& sampling, double cycles_per_px) {
  return sampling.quarters ? std::cos(pi * cycles_per_px / 2) : 1;
}

/// Transfer of a mean over a block of pixels, and of linear interpolation between blocks.
double block_transfer(double cycles_per_px) {
  const double x = pi * kHaloBlockPx * cycles_per_px;
  const double tent = x == 0 ? 1 : std::pow(std::sin(x) / x, 2);
  return mean_transfer(cycles_per_px, kHaloBlockPx, kHaloBlockPx) * tent;
}

/// Kernel offsets with equal weights by symmetry: (a, b) and (b, a) with all signs.
struct Orbit {
  bool is_halo = false;
  int a = 0;  ///< steps from the centre, b <= a
  int b = 0;
};

/// Offsets of core and halo, as multiples of a step.
class Offsets {
 public:
  Offsets(int reach_px, bool quarters)
      : quarters_(quarters), radius_(quarters ? 2 * reach_px - 1 : reach_px) {
    add(
        false, radius_, [&](int step) { return offset_px(step); }, reach_px + 0.3);
    add(
        true, kHaloRadius, [](int step) { return 1.0 * step; }, kHaloRadius + 0.3);
  }

  [[nodiscard]] const std::vector<Orbit>& orbits() const noexcept { return orbits_; }
  [[nodiscard]] int radius() const noexcept { return radius_; }

  /// In pixels; a quarter's centre is a quarter of a pixel from its pixel's.
  [[nodiscard]] double offset_px(int step) const noexcept { return quarters_ ? (step + 0.5) / 2 : step; }
  [[nodiscard]] double offset_px(const Orbit& orbit, int step) const noexcept {
    return orbit.is_halo ? 1.0 * kHaloBlockPx * step : offset_px(step);
  }

  /// Number of offsets in an orbit.
  [[nodiscard]] double count(const Orbit& orbit) const noexcept {
    const auto signs = [&](int step) { return offset_px(orbit, step) == 0 ? 1 : 2; };
    return signs(orbit.a) * signs(orbit.b) * (orbit.a == orbit.b ? 1 : 2);
  }

 private:
  template <typename Offset>
  void add(bool is_halo, int radius, const Offset& offset, double reach) {
    for (int a = 0; a <= radius; ++a) {
      for (int b = 0; b <= a; ++b)
        if (std::hypot(offset(a), offset(b)) <= reach)
          orbits_.push_back({.is_halo = is_halo, .a = a, .b = b});
    }
  }

  bool quarters_;
  int radius_;
  std::vector<Orbit> orbits_;
};

/// Sums of squares over all frequencies, from which any subset of offsets is solved.
struct NormalEquations {
  std::vector<double> matrix;
  std::vector<double> right;
};

/// One row of the least squares per frequency: the transfer of each orbit's offsets.
class Rows {
 public:
  Rows(const OpticsTransfer& lens, const PixelSampling& sampling, const Offsets& offsets)
      : frequencies_(sampling.quarters ? 1 : 0.5), offsets_(offsets), lens_(lens) {
    for (const double f : frequencies_.at) {
      samples_.push_back(sample_transfer(sampling, f));
      blocks_.push_back(block_transfer(f) * pixel_transfer(sampling, f));
    }
    const int steps = std::max(offsets.radius(), kHaloRadius) + 1;
    for (int step = 0; step < steps; ++step) {
      core_.push_back(cosines(offsets.offset_px(step)));
      halo_.push_back(cosines(1.0 * kHaloBlockPx * step));
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return frequencies_.at.size(); }
  [[nodiscard]] double at(std::size_t i) const noexcept { return frequencies_.at[i]; }

  /// Rows of both (i, j) and (j, i), j <= i; returns their target.
  double fill(std::size_t i, std::size_t j, std::vector<double>& row) const {
    const double samples = samples_[i] * samples_[j];
    const double blocks = blocks_[i] * blocks_[j];
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Orbit& orbit = offsets_.orbits()[k];
      const auto& waves = orbit.is_halo ? halo_ : core_;
      const std::vector<double>& a = waves[static_cast<std::size_t>(orbit.a)];
      const std::vector<double>& b = waves[static_cast<std::size_t>(orbit.b)];
      const double both = orbit.a == orbit.b ? a[i] * a[j] : a[i] * b[j] + b[i] * a[j];
      row[k] = both * samples * (orbit.is_halo ? blocks : 1);
    }
    return lens_.at(frequencies_.at[i], frequencies_.at[j]);
  }

  [[nodiscard]] double weight(std::size_t i, std::size_t j) const {
    return frequencies_.width[i] * frequencies_.width[j] * (i == j ? 1 : 2) *
           scene_power(std::hypot(frequencies_.at[i], frequencies_.at[j]));
  }

 private:
  [[nodiscard]] std::vector<double> cosines(double offset_px) const {
    std::vector<double> out;
    for (const double f : frequencies_.at)
      out.push_back(offset_px == 0 ? 1 : 2 * std::cos(2 * pi * offset_px * f));
    return out;
  }

  Frequencies frequencies_;
  const Offsets& offsets_;
  const OpticsTransfer& lens_;
  std::vector<double> samples_;
  std::vector<double> blocks_;
  std::vector<std::vector<double>> core_;  ///< [steps][frequencies]
  std::vector<std::vector<double>> halo_;
};

NormalEquations normal_equations(const Rows& rows, std::size_t count) {
  NormalEquations sums = {.matrix = std::vector<double>(count * count), .right = std::vector<double>(count)};
  std::vector<double> row(count);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double wanted = rows.fill(i, j, row);
      const double weight = rows.weight(i, j);
      for (std::size_t k = 0; k < count; ++k) {
        sums.right[k] += weight * row[k] * wanted;
        for (std::size_t l = 0; l <= k; ++l) sums.matrix[k * count + l] += weight * row[k] * row[l];
      }
    }
  }
  double trace = 0;
  for (std::size_t k = 0; k < count; ++k) trace += sums.matrix[k * count + k];
  for (std::size_t k = 0; k < count; ++k)
    sums.matrix[k * count + k] += 1e-12 * trace / static_cast<double>(count);
  return sums;
}

/// Weights of the chosen orbits, all others 0, with a sum over all offsets of 1.
std::vector<double> solve_chosen(const NormalEquations& sums, const std::vector<double>& counts,
                                 const std::vector<std::size_t>& chosen) {
  std::vector<double> matrix(chosen.size() * chosen.size());
  std::vector<double> right;
  std::vector<double> of_sum;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    for (std::size_t l = 0; l <= k; ++l)
      matrix[k * chosen.size() + l] = sums.matrix[chosen[k] * counts.size() + chosen[l]];
    right.push_back(sums.right[chosen[k]]);
    of_sum.push_back(counts[chosen[k]]);
  }
  const std::vector<double> weights = solve_with_sum(matrix, right, of_sum);
  std::vector<double> all(counts.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) all[chosen[k]] = weights[k];
  return all;
}

/// The same with weights of at least 0: orbits with a negative weight are left out until there is none.
std::vector<double> solve_positive(const NormalEquations& sums, const std::vector<double>& counts) {
  std::vector<std::size_t> chosen(counts.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = k;
  while (true) {
    std::vector<double> weights = solve_chosen(sums, counts, chosen);
    if (std::erase_if(chosen, [&](std::size_t k) { return weights[k] < 0; }) == 0) return weights;
  }
}

/// Fit for one radius.
struct Fit {
  Offsets offsets;
  std::vector<double> weights;  ///< of its orbits
  double misfit = 0;            ///< of the transfer, up to Nyquist

  [[nodiscard]] double weight_of(bool is_halo, int right, int down) const {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const Orbit& orbit = offsets.orbits()[k];
      if (orbit.is_halo == is_halo && orbit.a == std::max(right, down) && orbit.b == std::min(right, down))
        return weights[k];
    }
    return 0;
  }
};

double worst_misfit(const Rows& rows, const std::vector<double>& weights) {
  constexpr double kNyquist = 0.5;
  double worst = 0;
  std::vector<double> row(weights.size());
  for (std::size_t i = 0; i < rows.size() && rows.at(i) <= kNyquist; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double misfit = -rows.fill(i, j, row);
      for (std::size_t k = 0; k < row.size(); ++k) misfit += weights[k] * row[k];
      worst = std::max(worst, std::abs(misfit));
    }
  }
  return worst;
}

Fit fit_of(const OpticsTransfer& lens, const PixelSampling& sampling, int reach_px) {
  Fit fit = {.offsets = Offsets(reach_px, sampling.quarters), .weights = {}};
  const Rows rows(lens, sampling, fit.offsets);
  std::vector<double> counts;
  for (const Orbit& orbit : fit.offsets.orbits()) counts.push_back(fit.offsets.count(orbit));
  fit.weights = solve_positive(normal_equations(rows, counts.size()), counts);
  fit.misfit = worst_misfit(rows, fit.weights);
  return fit;
}

template <typename Weight>
QuadrantKernel quadrant(int radius, const Weight& weight) {
  QuadrantKernel kernel = {.radius = radius, .weights = {}};
  for (int down = 0; down <= radius; ++down) {
    for (int right = 0; right <= radius; ++right)
      kernel.weights.push_back(static_cast<float>(weight(right, down)));
  }
  return kernel;
}

/// Weight of the quarter whose centre is (2 pixels + side) / 4 pixels away; side is 1 or -1.
double quarter_weight(const Fit& fit, int right_px, int right_side, int down_px, int down_side) {
  const auto step = [](int px, int side) { return (std::abs(4 * px + side) - 1) / 2; };
  return fit.weight_of(false, step(right_px, right_side), step(down_px, down_side));
}

/// Sum over a pixel's quarters, with a sign for its right or lower ones.
template <typename Sign>
QuadrantKernel of_quarters(const Fit& fit, int reach_px, const Sign& sign) {
  return quadrant(reach_px, [&](int right, int down) {
    double sum = 0;
    for (const int right_side : {-1, 1}) {
      for (const int down_side : {-1, 1})
        sum += sign(right_side, down_side) * quarter_weight(fit, right, right_side, down, down_side);
    }
    return sum;
  });
}

/// Sum over all quadrants, without the centre.
double sum_around(const QuadrantKernel& kernel) {
  double sum = 0;
  for (int down = 0; down <= kernel.radius; ++down) {
    for (int right = 0; right <= kernel.radius; ++right) {
      if (right == 0 && down == 0) continue;
      sum += (right > 0 ? 2 : 1) * (down > 0 ? 2 : 1) * static_cast<double>(kernel.at(right, down));
    }
  }
  return sum;
}

RoundKernel kernel_of(const Fit& fit, int reach_px, bool quarters) {
  RoundKernel kernel;
  kernel.halo = quadrant(kHaloRadius, [&](int right, int down) { return fit.weight_of(true, right, down); });
  if (quarters) {
    kernel.pixel = of_quarters(fit, reach_px, [](int, int) { return 1; });
    kernel.across = of_quarters(fit, reach_px, [](int right_side, int) { return right_side; });
    kernel.crossed =
        of_quarters(fit, reach_px, [](int right_side, int down_side) { return right_side * down_side; });
  } else {
    kernel.pixel = quadrant(reach_px, [&](int right, int down) { return fit.weight_of(false, right, down); });
  }
  const double rest =
      sum_around(kernel.pixel) + sum_around(kernel.halo) + static_cast<double>(kernel.halo.at(0, 0));
  kernel.pixel.weights.front() = static_cast<float>(1 - rest);
  return kernel;
}

/// Transfer of a kernel that is even (or odd, by sines) along both axes.
template <typename Right, typename Down>
double sum_of_waves(const QuadrantKernel& kernel, const Right& right_wave, const Down& down_wave) {
  double sum = 0;
  for (int down = 0; down <= kernel.radius; ++down) {
    for (int right = 0; right <= kernel.radius; ++right)
      sum += static_cast<double>(kernel.at(right, down)) * right_wave(right) * down_wave(down);
  }
  return sum;
}

}  // namespace

RoundKernel round_kernel(const OpticsParameters& optics, const SpectralResponse& response,
                         const PixelSampling& sampling) {
  assert(sampling.across >= 1 && !(sampling.quarters && sampling.across % 2 == 1));
  constexpr double kWorthwhile = 0.9;  // a larger reach must reduce the misfit to this share
  const OpticsTransfer lens(optics, response);
  int reach_px = kReachesPx.front();
  Fit best = fit_of(lens, sampling, reach_px);
  for (std::size_t i = 1; i < kReachesPx.size() && best.misfit > kGoodMisfit; ++i) {
    Fit wider = fit_of(lens, sampling, kReachesPx.at(i));
    if (wider.misfit > kWorthwhile * best.misfit) break;
    best = std::move(wider);
    reach_px = kReachesPx.at(i);
  }
  return kernel_of(best, reach_px, sampling.quarters);
}

double sampled_mtf(const RoundKernel& kernel, const PixelSampling& sampling, double across_cycles_per_px,
                   double down_cycles_per_px) noexcept {
  const auto even = [](double cycles) {
    return [cycles](int step) { return step == 0 ? 1 : 2 * std::cos(2 * pi * cycles * step); };
  };
  const auto odd = [](double cycles) {
    return [cycles](int step) { return 2 * std::sin(2 * pi * cycles * step); };
  };
  const double x = across_cycles_per_px;
  const double y = down_cycles_per_px;
  const double samples = sample_transfer(sampling, x) * sample_transfer(sampling, y);
  const double halo = block_transfer(x) * block_transfer(y) *
                      sum_of_waves(kernel.halo, even(kHaloBlockPx * x), even(kHaloBlockPx * y));
  double transfer = pixel_transfer(sampling, x) * pixel_transfer(sampling, y) *
                    (sum_of_waves(kernel.pixel, even(x), even(y)) + halo);
  if (sampling.quarters) {
    const double half_x = pi * x / 2;
    const double half_y = pi * y / 2;
    transfer -= std::sin(half_x) * std::cos(half_y) * sum_of_waves(kernel.across, odd(x), even(y));
    transfer -= std::cos(half_x) * std::sin(half_y) * sum_of_waves(kernel.across, odd(y), even(x));
    transfer += std::sin(half_x) * std::sin(half_y) * sum_of_waves(kernel.crossed, odd(x), odd(y));
  }
  return samples * transfer;
}

}  // namespace thermal
