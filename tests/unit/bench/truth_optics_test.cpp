#include <cmath>
#include <complex>
#include <numbers>

#include "bench/truth/optics.h"
#include "support/catch.h"
#include "support/golden.h"

namespace truth_optics_test {

using namespace thermal;
using std::numbers::pi;

namespace {

/// Coarse but for what a test looks at: 32 px hold all but 0.5 % of the light.
constexpr TruthSteps kSteps = {
    .lines_per_px = 16, .cells_per_px = 16, .wavelengths = 48, .times_per_cell = 8, .radius_px = 32};
constexpr GreySurface kTarget = {300, 1};
constexpr GreySurface kCold = {200, 0};

/// A band so narrow that all light has one wavelength, of 10 um.
TruthCamera one_wavelength() { return {.begin_um = 9.999, .end_um = 10.001}; }

double diffraction(double v) { return v >= 1 ? 0 : 2 / pi * (std::acos(v) - v * std::sqrt(1 - v * v)); }

double sinc(double cycles_per_px) { return std::sin(pi * cycles_per_px) / (pi * cycles_per_px); }

/// Integral over all lines up to an offset along x.
double up_to(const ContrastKernel& kernel, double x_px) {
  const TruthSteps& steps = kernel.steps();
  const int lines = steps.radius_px * steps.lines_per_px;
  double sum = 0;
  for (int line = -lines; line < lines; ++line) sum += kernel.up_to(x_px, line);
  return sum / steps.lines_per_px;
}

/// Transfer along x, from running integrals.
double transfer(const ContrastKernel& kernel, double cycles_per_px) {
  constexpr double kStep = 1.0 / 32;
  std::complex<double> sum;
  double before = 0;
  for (double x = -kernel.steps().radius_px; x <= kernel.steps().radius_px; x += kStep) {
    const double next = up_to(kernel, x);
    sum += (next - before) * std::polar(1.0, 2 * pi * cycles_per_px * (x - kStep / 2));
    before = next;
  }
  return std::abs(sum) / kernel.contrast_w_m2_sr();
}

}  // namespace

TEST_CASE("the truth's Planck integral agrees with the golden values") {
  int compared = 0;
  for (const GoldenRow& row : read_golden("band_radiance_8_14um.csv")) {
    if (row.numbers[0] < 200 || row.numbers[0] > 2000) continue;
    CHECK_THAT(truth_band_radiance(8, 14, row.numbers[0]), WithinRel(row.numbers[1], 1e-7));
    ++compared;
  }
  CHECK(compared > 5);
}

TEST_CASE("the truth's temperature is the inverse of its radiance") {
  const TruthCamera camera;
  for (const double kelvin : {200.0, 278.0, 300.0, 655.35, 1500.0}) {
    const double radiance = truth_band_radiance(camera.begin_um, camera.end_um, kelvin);
    CHECK_THAT(truth_temperature_k(camera, radiance), WithinAbs(kelvin, 1e-6));
  }
}

TEST_CASE("an Airy pattern has its first dark ring where the closed form has it, and holds 83.8 % within") {
  const TruthCamera camera;
  const double ring_px = 1.21967 * 10 * camera.f_number / camera.pitch_um;
  CHECK(airy_per_px2(camera, 10, ring_px) < 1e-9 * airy_per_px2(camera, 10, 0));
  constexpr int kRings = 2000;
  double within = 0;
  for (int i = 0; i < kRings; ++i) {
    const double radius_px = (i + 0.5) * ring_px / kRings;
    within += airy_per_px2(camera, 10, radius_px) * 2 * pi * radius_px * ring_px / kRings;
  }
  CHECK_THAT(within, WithinAbs(0.8378, 1e-4));  // 1 - J0(3.8317)^2
}

TEST_CASE("a kernel holds all light but the Airy pattern's tail") {
  const TruthCamera camera = one_wavelength();
  const ContrastKernel kernel(camera, kTarget, kCold, kSteps);
  const double sum = up_to(kernel, kSteps.radius_px) / kernel.contrast_w_m2_sr();
  // Beyond a radius r: 2 / (pi^2 r) of px_per_cycle; beyond a square of half side r, 2 sqrt(2) / pi = 0.9 of that.
  const double px_per_cycle = 10 * camera.f_number / camera.pitch_um;
  const double tail = 2 * std::numbers::sqrt2 / pi * 2 * px_per_cycle / (pi * pi * kSteps.radius_px);
  CHECK_THAT(sum, WithinAbs(1 - tail, 2e-4));
}

TEST_CASE("a kernel has the transfer of a round aperture, a Gaussian and a square pixel") {
  const TruthCamera camera = one_wavelength();
  const ContrastKernel kernel(camera, kTarget, kCold, kSteps);
  for (const double frequency : {0.1, 0.25, 0.5, 0.8}) {
    const double gaussian = std::exp(-2 * std::pow(pi * frequency * camera.aberration_sigma_px, 2));
    const double exact =
        diffraction(frequency * 10 * camera.f_number / camera.pitch_um) * gaussian * sinc(frequency);
    CHECK_THAT(transfer(kernel, frequency), WithinAbs(exact, 2e-3));  // the tail beyond 32 px
  }
}

TEST_CASE("all wavelengths together have the mean of their transfers") {
  const TruthCamera camera;
  const ContrastKernel kernel(camera, kTarget, kCold, kSteps);
  constexpr double kFrequency = 0.4;
  constexpr int kNodes = 500;
  double sum = 0;
  double weights = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double wavelength_um = 7.5 + 6 * (i + 0.5) / kNodes;
    const double weight = truth_band_radiance(wavelength_um - 0.006, wavelength_um + 0.006, 300);
    sum += weight * diffraction(kFrequency * wavelength_um * camera.f_number / camera.pitch_um);
    weights += weight;
  }
  const double rest = std::exp(-2 * std::pow(pi * kFrequency * 0.25, 2)) * sinc(kFrequency);
  CHECK_THAT(transfer(kernel, kFrequency), WithinAbs(rest * sum / weights, 2e-3));
}

TEST_CASE("a moving edge behind a Gaussian is smeared as in closed form") {
  const TruthCamera camera = {.gaussian_sigma_px = 0.5};
  const ContrastKernel kernel(camera, kTarget, kCold, kSteps);
  for (const double smear_px : {0.05, 0.7, 2.5}) {
    const ContrastKernel smeared = kernel.smeared(smear_px);
    for (const double x_px : {-2.0, -0.3, 0.0, 0.4, 1.7, 6.0}) {
      // An exponentially modified Gaussian: normal(x) - exp(s^2 / 2 l^2 - x / l) normal(x - s^2 / l).
      const auto normal = [](double x) { return 0.5 * std::erfc(-x / (0.5 * std::numbers::sqrt2)); };
      const double shift = 0.25 / smear_px;
      const double exact =
          normal(x_px) - std::exp(0.125 / (smear_px * smear_px) - x_px / smear_px) * normal(x_px - shift);
      CHECK_THAT(up_to(smeared, x_px) / kernel.contrast_w_m2_sr(), WithinAbs(exact, 1e-4));
    }
  }
}

}  // namespace truth_optics_test
