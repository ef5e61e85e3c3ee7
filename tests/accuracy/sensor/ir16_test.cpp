#include <algorithm>
#include <cmath>

#include "support/cameras.h"
#include "support/catch.h"

namespace ir16_test {

using namespace thermal;

namespace {

const BandRadiance kBand(SpectralResponse::flat(8, 14));
constexpr double kRounding = 6e-8;  // half of float's eps

/// Largest difference [K] between a temperature and that of its 16-bit count, for every step from low to high.
double worst_error_k(double kelvin_per_count, double low_k, double high_k) {
  constexpr int kSteps = 50000;
  SensorParameters parameters = cameras::perfect_sensor();
  parameters.kelvin_per_count = kelvin_per_count;
  Plane<float> scene(kSteps, 1);
  const auto temperature_k = [&](int step) { return low_k + (high_k - low_k) * step / (kSteps - 1); };
  for (int step = 0; step < kSteps; ++step) {
    scene.at(step, 0) = static_cast<float>(kBand.radiance(temperature_k(step)));
  }
  const SensorFrame frame = cameras::camera(parameters, {.width_px = kSteps, .height_px = 1}).expose(scene);
  double worst = 0;
  for (int step = 0; step < kSteps; ++step) {
    worst = std::max(worst, std::abs(kelvin_per_count * frame.ir16.at(step, 0) - temperature_k(step)));
  }
  return worst;
}

}  // namespace

TEST_CASE("A 16-bit count gives the apparent temperature to half a count, 200 to 400 K") {
  // 16 bits of 0.0065 K reach 426 K; finer steps do not reach 400 K.
  const double kelvin_per_count = GENERATE(0.0065, 0.01, 0.1);
  const double worst_k = worst_error_k(kelvin_per_count, 200, 400);
  const double half_count_k = kelvin_per_count / 2;
  // On top of half a count: the table's linear interpolation, and single precision: radiance in and its position in
  // the table, 3 kRounding of L at L / L' < 100 K; temperature and count, 3 kRounding of 400 K.
  const double table_k = TemperatureTable([](double radiance) { return kBand.temperature(radiance); },
                                          kBand.radiance(180), kBand.radiance(420))
                             .worst_error_k();
  CAPTURE(kelvin_per_count, worst_k, table_k);
  CHECK(worst_k <= half_count_k + table_k + 3 * kRounding * 100 + 3 * kRounding * 400);
  CHECK(worst_k >= 0.99 * half_count_k);  // of 50,000 temperatures some are halfway between two counts
}

TEST_CASE("The finest step gives the lowest temperatures it can represent to half a count") {
  const double worst_k = worst_error_k(0.001, 40, 65.5);  // exact inverse: below the table
  CHECK(worst_k <= 0.0005 + 6 * kRounding * 65.5);
  CHECK(worst_k >= 0.99 * 0.0005);
}

}  // namespace ir16_test
