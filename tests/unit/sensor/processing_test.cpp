#include "sensor/processing.h"

#include <cmath>
#include <numbers>

#include "sensor/optics/psf.h"
#include "support/catch.h"
#include "support/planes.h"

namespace processing_test {

using namespace thermal;

namespace {

using Counts = Plane<std::uint16_t>;

constexpr double kMiddle = 28000;
constexpr unsigned kLowest = 28000;

double gaussian_mtf(double sigma_px, double cycles_per_px) {
  return std::exp(-2 * std::pow(std::numbers::pi * sigma_px * cycles_per_px, 2));
}

/// Amplitude of what becomes of a wave along rows, 20 periods and their mirror image away from the borders.
double transfer(const ProcessingParameters& parameters, int period_px) {
  constexpr double kAmplitude = 4000;
  const int width_px = 60 * period_px;
  const auto phase = [&](int x) { return 2 * std::numbers::pi * x / period_px; };
  Counts wave(width_px, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < width_px; ++x)
      wave.at(x, y) = static_cast<std::uint16_t>(std::lround(kMiddle + kAmplitude * std::cos(phase(x))));
  Processing processing(parameters);
  const Counts& filtered = processing.filter(wave);
  double sum = 0;
  for (int x = 20 * period_px; x < 40 * period_px; ++x) sum += filtered.at(x, 1) * std::cos(phase(x));
  return 2 * sum / (20 * period_px) / kAmplitude;
}

}  // namespace

TEST_CASE("Nothing is filtered unless it is asked for") {
  const Counts counts = planes::random_counts(20, 10, kLowest, 1000);
  Processing processing({});
  CHECK(&processing.filter(counts) == &counts);
}

TEST_CASE("A noise filter and an unsharp mask have the stated transfer") {
  const double noise_sigma_px = GENERATE(0.0, 0.6, 0.9);
  const double amount = GENERATE(0.0, 0.5, 1.5);
  const double sigma_px = GENERATE(1.5, 2.5);
  const int period_px = GENERATE(3, 5, 8, 16, 40);
  CAPTURE(noise_sigma_px, amount, sigma_px, period_px);
  const double frequency = 1.0 / period_px;
  const auto mtf_of = [&](double sigma) { return kernel_mtf(gaussian_psf(sigma), frequency); };
  const double found = transfer({noise_sigma_px, amount, sigma_px}, period_px);
  // Counts are rounded: their error of at most 0.5 of 4000 adds up to less than that in the amplitude.
  CHECK_THAT(found, WithinAbs(mtf_of(noise_sigma_px) * (1 + amount * (1 - mtf_of(sigma_px))), 3e-4));
  const double ideal =
      gaussian_mtf(noise_sigma_px, frequency) * (1 + amount * (1 - gaussian_mtf(sigma_px, frequency)));
  CHECK_THAT(found, WithinAbs(ideal, 0.03 * (1 + amount)));
}

TEST_CASE("A noise filter colours noise") {
  const double sigma_px = GENERATE(0.7, 0.8, 0.9);
  CAPTURE(sigma_px);
  Processing processing({.noise_filter_sigma_px = sigma_px});
  const Counts& filtered = processing.filter(planes::random_counts(300, 300, kLowest, 1000));
  // Standard error of a correlation over 90,000 pixels, some 5 of which are one: 0.0075; the kernel's: 0.015.
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 1}, {2, 0}}) {
    const double expected = std::exp(-(x * x + y * y) / (4 * sigma_px * sigma_px));
    CHECK_THAT(planes::correlation(filtered, x, y), WithinAbs(expected, 0.04));
  }
}

TEST_CASE("What is not measured and what is clipped stays, and nothing joins it") {
  Counts counts(9, 9, 3);
  counts.at(4, 4) = 65535;
  counts.at(1, 1) = 0;
  Processing processing({.unsharp_amount = 5});
  const Counts& filtered = processing.filter(counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::uint16_t before = counts.pixels()[i];
    const std::uint16_t after = filtered.pixels()[i];
    if (before == 3) CHECK((after >= 1 && after <= 65534));
    if (before != 3) CHECK(after == before);
  }
}

}  // namespace processing_test
