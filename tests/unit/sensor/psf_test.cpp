#include "sensor/optics/psf.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"

namespace psf_test {

using namespace thermal;

namespace {

using std::numbers::pi;

const SpectralResponse kBand = SpectralResponse::flat(8, 14);
constexpr double kNyquist = 0.5;

OpticsParameters physical(double f_number, double pixel_pitch_um, double aberration_sigma_px = 0.25) {
  return {.psf = Psf::physical,
          .f_number = f_number,
          .aberration_sigma_px = aberration_sigma_px,
          .pixel_pitch_um = pixel_pitch_um};
}

double gaussian(double cycles_per_px, double sigma_px) {
  return std::exp(-2 * std::pow(pi * sigma_px * cycles_per_px, 2));
}

/// Overlap of two discs of radius 1 whose centres are 2 v apart, as a fraction of a disc, strip by strip: the
/// definition of an incoherent transfer function.
double disc_overlap(double v) {
  constexpr int kStrips = 20000;
  double sum = 0;
  for (int i = 0; i < kStrips; ++i) {
    const double x = v + (1 - v) * (i + 0.5) / kStrips;
    sum += std::sqrt(1 - x * x) * (1 - v) / kStrips;
  }
  return 4 * sum / pi;
}

}  // namespace

TEST_CASE("A lens transfers the overlap of two shifted apertures") {
  for (const double v : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    CAPTURE(v);
    // Strips of a square root's end: error below (1 - v) / strips.
    CHECK_THAT(diffraction_mtf(1000 * v / (10 * 1.25), 10, 1.25), WithinAbs(disc_overlap(v), 1e-5));
  }
  CHECK(diffraction_mtf(0, 10, 1) == 1);
  CHECK(diffraction_mtf(100, 10, 1) == 0);  // the cut-off, 1 / (wavelength * f-number)
  CHECK(diffraction_mtf(1e9, 10, 1) == 0);
}

TEST_CASE("At Nyquist a lens, a pixel and a quarter of a pixel transfer the published figures") {
  struct Golden {
    double f_number;
    double pixel_pitch_um;
    double at_10_6_um;
    double over_band;
  };
  // at_10_6_um: PHYSICS.md section 5, three digits; they are those of 10.6 um alone. over_band: 8-14 um, weighted
  // with the radiance of 300 K, by the trapezoid rule with 20,000 steps in double precision elsewhere; 0.004 to 0.006
  // lower, because the band's centre is at 11 um and its long waves have more weight than its short ones.
  const auto golden = GENERATE(Golden{1, 12, 0.213, 0.20804}, Golden{1, 17, 0.285, 0.28067},
                               Golden{1.25, 12, 0.156, 0.15090}, Golden{1.25, 17, 0.242, 0.23650});
  CAPTURE(golden.f_number, golden.pixel_pitch_um);
  const double cycles_per_mm = 500 / golden.pixel_pitch_um;
  const double alone = diffraction_mtf(cycles_per_mm, 10.6, golden.f_number) * (2 / pi) * gaussian(0.5, 0.25);
  CHECK_THAT(alone, WithinAbs(golden.at_10_6_um, 0.0006));  // the last digit, and 10.6 um is known to 0.01 um
  // 96 midpoints instead of 20,000 change no transfer by 1e-5; the golden value is rounded to as much.
  CHECK_THAT(optics_mtf(physical(golden.f_number, golden.pixel_pitch_um), kBand, kNyquist),
             WithinAbs(golden.over_band, 1.5e-5));
}

TEST_CASE("The plain Gaussian is its own transfer function") {
  const OpticsParameters optics = {.psf = Psf::gaussian, .blur_sigma_px = 1};
  for (const double cycles : {0.0, 0.1, 0.25, 0.5}) {
    CAPTURE(cycles);
    CHECK_THAT(optics_mtf(optics, kBand, cycles), WithinAbs(gaussian(cycles, 1), 1e-15));
    // Sampling adds the aliases. The truncation at 4 sigma drops 6.3e-5 of the weight, and scaling distributes it:
    // twice that.
    CHECK_THAT(kernel_mtf(gaussian_psf(optics.blur_sigma_px), cycles),
               WithinAbs(gaussian(cycles, 1) + gaussian(1 - cycles, 1) + gaussian(1 + cycles, 1), 1.3e-4));
  }
  CHECK_THAT(optics_mtf(optics, kBand, kNyquist), WithinAbs(0.0072, 5e-5));  // PHYSICS.md: .007, far too soft
}

TEST_CASE("A Gaussian too narrow for its samples is fitted instead") {
  const double sigma_px = GENERATE(0.25, 0.5, 0.7, 0.9, 1.0, 2.5);
  const OpticsParameters optics = {.psf = Psf::gaussian, .blur_sigma_px = sigma_px};
  const HalfKernel kernel = gaussian_psf(optics.blur_sigma_px);
  for (double cycles = 0; cycles <= 0.5; cycles += 0.005) {
    CAPTURE(sigma_px, cycles);
    REQUIRE_THAT(kernel_mtf(kernel, cycles), WithinAbs(gaussian(cycles, sigma_px), 0.015));
  }
}

TEST_CASE("Without a sigma a Gaussian leaves the picture sharp") {
  CHECK(gaussian_psf(0) == HalfKernel{1.0F});
}

TEST_CASE("A sharp lens and a narrow band leave the footprint alone") {
  const OpticsParameters optics = physical(1e-6, 17, 0);
  for (const double cycles : {0.1, 0.3, 0.5}) {
    CHECK_THAT(optics_mtf(optics, kBand, cycles), WithinAbs(std::sin(pi * cycles) / (pi * cycles), 1e-6));
  }
}

namespace {

/// Transfer of a defocused lens by sums over the overlap of two apertures, point by point.
double transfer_by_points(double v, double phase) {
  constexpr int kSide = 2000;
  double sum = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = (column + 0.5) * 2 / kSide - 1;
      const double y = (row + 0.5) * 2 / kSide - 1;
      if (std::hypot(x - v, y) <= 1 && std::hypot(x + v, y) <= 1) sum += std::cos(phase * x);
    }
  }
  return sum * 4 / (pi * kSide * kSide);
}

}  // namespace

TEST_CASE("Out of focus, the apertures' overlap is weighted by the difference in phase") {
  constexpr double kWavelengthUm = 10;
  constexpr double kFNumber = 1.25;
  for (const double v : {0.1, 0.3, 0.6}) {
    for (const double defocus_um : {0.01, 5.0, 40.0, -40.0, 150.0}) {
      CAPTURE(v, defocus_um);
      // W = defocus / (8 F^2) at the aperture's edge; a shift of 2 v differs by 4 v W x, times 2 pi / wavelength.
      const double phase = 8 * pi * v * defocus_um / (8 * kFNumber * kFNumber) / kWavelengthUm;
      CHECK_THAT(diffraction_mtf(1000 * v / (kWavelengthUm * kFNumber), kWavelengthUm, kFNumber, defocus_um),
                 WithinAbs(transfer_by_points(v, phase), 1e-4));  // 4 million points
    }
  }
}

TEST_CASE("Far out of focus, a point is a disc of light") {
  // Geometric optics: the image of a point is a disc of diameter defocus / F, whose transfer is 2 J1(z) / z,
  // z = pi f diameter. Diffraction is small if the disc is much wider than the Airy pattern.
  constexpr double kDefocusUm = 2000;
  constexpr double kFNumber = 2;
  for (const double z : {0.5, 1.0, 2.0, 3.0, 5.0}) {
    CAPTURE(z);
    const double cycles_per_mm = 1e3 * z / (pi * kDefocusUm / kFNumber);
    const double disc = 2 * std::cyl_bessel_j(1, z) / z;
    CHECK_THAT(diffraction_mtf(cycles_per_mm, 10, kFNumber, kDefocusUm), WithinAbs(disc, 0.02));
  }
}

TEST_CASE("The tabulated transfer is that of the lens, and of a square pixel in all directions") {
  OpticsParameters optics = physical(1.25, 17);
  optics.defocus_um = GENERATE(0.0, 40.0);
  const OpticsTransfer transfer(optics, kBand);
  for (double cycles = 0; cycles < 2; cycles += 0.0137) {
    CAPTURE(cycles);
    REQUIRE_THAT(transfer.at(cycles, 0), WithinAbs(optics_mtf(optics, kBand, cycles), 2e-5));
    REQUIRE(transfer.at(0, cycles) == transfer.at(cycles, 0));
    const double x = cycles * 0.6;
    const double y = cycles * 0.8;
    const auto sinc = [](double at) { return at == 0 ? 1 : std::sin(pi * at) / (pi * at); };
    if (std::abs(sinc(cycles)) > 0.1) {
      REQUIRE_THAT(transfer.at(x, y),
                   WithinAbs(optics_mtf(optics, kBand, cycles) / sinc(cycles) * sinc(x) * sinc(y), 1e-4));
    }
  }
  CHECK(transfer.at(5, 5) == 0);
}

TEST_CASE("A kernel's transfer is the Fourier sum of its weights") {
  const HalfKernel kernel = {0.5F, 0.25F};
  CHECK_THAT(kernel_mtf(kernel, 0), WithinAbs(1, 1e-15));
  CHECK_THAT(kernel_mtf(kernel, 0.25), WithinAbs(0.5, 1e-15));
  CHECK_THAT(kernel_mtf(kernel, 0.5), WithinAbs(0, 1e-15));
}

}  // namespace psf_test
