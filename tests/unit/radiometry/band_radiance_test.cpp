#include "radiometry/band_radiance.h"

#include <cmath>
#include <limits>

#include "radiometry/planck.h"
#include "support/catch.h"

namespace band_radiance_test {

using namespace thermal;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

const BandRadiance kBand(SpectralResponse::flat(8, 14));

void check_dark(const BandValue& value) {
  CHECK(value.radiance_w_m2_sr == 0);
  CHECK(value.derivative_w_m2_sr_k == 0);
  CHECK(value.ln_radiance == -kInfinity);
}

}  // namespace

TEST_CASE("At and below absolute zero a band is dark") {
  const double temperature_k = GENERATE(0.0, -0.0, -kDenormal, -1.0, -300.0, -kInfinity);
  check_dark(kBand.evaluate(temperature_k));
}

TEST_CASE("A denormal temperature is dark, without dividing by zero") {
  check_dark(kBand.evaluate(kDenormal));
  check_dark(kBand.evaluate(1e-310));
}

TEST_CASE("The logarithm is accurate below the smallest double") {
  const BandValue value = kBand.evaluate(1);
  CHECK(value.radiance_w_m2_sr == 0);
  CHECK(std::isfinite(value.ln_radiance));
  // At very low temperatures only -x at the long-wave end counts: c2 / (14 um T). The rest, logarithms of some 100,
  // is 1e-10 of it at 1e-9 K.
  constexpr double kColdest = 1e-9;
  const double x_end = kSecondRadiationConstant / (14e-6 * kColdest);
  CHECK_THAT(kBand.evaluate(kColdest).ln_radiance, WithinRel(-x_end, 1e-9));
}

TEST_CASE("The radiance underflows gradually, in the order of temperature") {
  double before = 0;
  for (double temperature_k = 1.37; temperature_k < 1.46; temperature_k += 0.001) {
    const double radiance = kBand.radiance(temperature_k);
    CHECK(radiance >= before);
    before = radiance;
  }
  CHECK(before >= std::numeric_limits<double>::min());  // 1.448 K on, it is a normal double
  CHECK(kBand.radiance(1.44) > 0);
  CHECK(kBand.radiance(1.44) < std::numeric_limits<double>::min());
}

TEST_CASE("NaN stays NaN") {
  const BandValue value = kBand.evaluate(kNaN);
  CHECK(std::isnan(value.radiance_w_m2_sr));
  CHECK(std::isnan(value.derivative_w_m2_sr_k));
  CHECK(std::isnan(value.ln_radiance));
  CHECK(std::isnan(kBand.temperature(kNaN)));
  CHECK(std::isnan(kBand.temperature_from_ln(kNaN)));
}

TEST_CASE("At infinite temperature the derivative is that of Rayleigh and Jeans") {
  const BandValue value = kBand.evaluate(kInfinity);
  CHECK(value.radiance_w_m2_sr == kInfinity);
  CHECK(value.ln_radiance == kInfinity);
  // dL/dT = 2 c k times the integral of wavelength^-4, c1L / c2 being 2 c k; about 40 roundings of 1.1e-16.
  const double integral_per_m3 = (std::pow(8e-6, -3) - std::pow(14e-6, -3)) / 3;
  const double expected = kFirstRadiationConstant / kSecondRadiationConstant * integral_per_m3;
  CHECK_THAT(value.derivative_w_m2_sr_k, WithinRel(expected, 40 * 1.1e-16));
}

TEST_CASE("The largest finite temperature does not overflow") {
  const BandValue value = kBand.evaluate(1e300);
  CHECK(std::isfinite(value.radiance_w_m2_sr));
  CHECK_THAT(value.radiance_w_m2_sr, WithinRel(1e300 * value.derivative_w_m2_sr_k, 1e-14));  // L = T dL/dT
}

TEST_CASE("No radiance means 0 K, infinite radiance infinity") {
  CHECK(kBand.temperature(0) == 0);
  CHECK(kBand.temperature(-0.0) == 0);
  CHECK(kBand.temperature(-5) == 0);
  CHECK(kBand.temperature(-kInfinity) == 0);
  CHECK(kBand.temperature(kInfinity) == kInfinity);
  CHECK(kBand.temperature_from_ln(-kInfinity) == 0);
  CHECK(kBand.temperature_from_ln(kInfinity) == kInfinity);
}

TEST_CASE("The inverse of the smallest radiance is where the forward function underflows") {
  const double temperature_k = kBand.temperature(kDenormal);
  CHECK(temperature_k > 1.37);
  CHECK(temperature_k < 1.40);
}

TEST_CASE("Radiance increases monotonically with temperature") {
  double before = -kInfinity;
  for (double temperature_k = 1e-2; temperature_k < 1e9; temperature_k *= 1.01) {
    const double ln_radiance = kBand.evaluate(temperature_k).ln_radiance;
    REQUIRE(ln_radiance > before);
    before = ln_radiance;
  }
}

TEST_CASE("The derivative is the slope of the radiance") {
  const double temperature_k = GENERATE(10.0, 80.0, 273.15, 300.0, 1000.0, 1e5);
  const double step_k = 1e-5 * temperature_k;
  const double rise = kBand.radiance(temperature_k + step_k) - kBand.radiance(temperature_k - step_k);
  // A central difference is off by (step / T)^2 / 6 * x^2 with x <= 103 at 10 K: 2e-7; rounding of the two
  // radiances, kappa * 1e-15 each, over a difference of 2e-5 kappa of them: 1e-10.
  CHECK_THAT(rise / (2 * step_k), WithinRel(kBand.evaluate(temperature_k).derivative_w_m2_sr_k, 3e-7));
}

TEST_CASE("Zero response at the ends adds nothing") {
  const BandRadiance tight(SpectralResponse({{8, 0}, {10, 1}, {14, 0}}));
  const BandRadiance wide(SpectralResponse({{0.5, 0}, {8, 0}, {10, 1}, {14, 0}, {20, 0}, {100, 0}}));
  const double temperature_k = GENERATE(2.0, 30.0, 300.0, 5000.0);
  // Skipped completely, not merely small: at 2 K the band at 100 um would outshine 8-14 um by e^440.
  CHECK(wide.radiance(temperature_k) == tight.radiance(temperature_k));
  CHECK(wide.evaluate(temperature_k).ln_radiance == tight.evaluate(temperature_k).ln_radiance);
}

TEST_CASE("A band is the sum of its parts") {
  const BandRadiance low(SpectralResponse::flat(8, 11));
  const BandRadiance high(SpectralResponse::flat(11, 14));
  const double temperature_k = GENERATE(30.0, 300.0, 1e4);
  // Each is good to (8 kappa + 60) roundings, kappa <= 60 at 30 K for 8-11 um, which hardly counts there.
  const double tolerance = (8 * 60 + 60) * 1.1e-16;
  CHECK_THAT(low.radiance(temperature_k) + high.radiance(temperature_k),
             WithinRel(kBand.radiance(temperature_k), tolerance));
}

TEST_CASE("Finer samples of the same response change nothing") {
  const BandRadiance coarse(SpectralResponse({{8, 0.2}, {14, 1}}));
  std::vector<SpectralResponse::Sample> samples;
  for (int i = 0; i <= 600; ++i) samples.push_back({8 + 0.01 * i, 0.2 + 0.8 * i / 600});
  const BandRadiance fine((SpectralResponse(samples)));
  // As above, plus 600 sums of 12 points: their roundings add up to at most 600 / 2 of the total each way.
  CHECK_THAT(fine.radiance(300), WithinRel(coarse.radiance(300), (600 + 100) * 1.1e-16));
}

}  // namespace band_radiance_test
