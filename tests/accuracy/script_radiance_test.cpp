#include <cmath>
#include <limits>

#include "radiometry/band_radiance.h"
#include "radiometry/planck.h"
#include "support/catch.h"
#include "support/golden.h"

namespace script_radiance_test {

using namespace thermal;

TEST_CASE("The published script's sum is reproduced to rounding") {
  for (const GoldenRow& row : read_golden("script_radiance.csv")) {
    const double temperature_k = row.numbers[0];
    CAPTURE(temperature_k);
    // x = c2 / (wavelength T), at most 60 at 30 K, carries 4 roundings of 1.1e-16 (0.01 is not exact in a double);
    // e^x - 1 loses nothing as x >= 1; 600 positive summands add at most 600 roundings.
    const double x = 14387.9 / (8 * temperature_k);
    const double bound = (4 * x + 600) * 1.11e-16;
    CHECK_THAT(script_radiance(temperature_k), WithinRel(row.numbers[1], bound));
  }
}

TEST_CASE("The script is 1.4e-3 or 92 mK too low at 300 K") {
  const BandValue exact = BandRadiance(SpectralResponse::flat(8, 14)).evaluate(300);
  const double difference = script_radiance(300) - exact.radiance_w_m2_sr;
  // Both figures are as published, rounded to the digits shown.
  CHECK_THAT(difference / exact.radiance_w_m2_sr, WithinAbs(-1.4e-3, 0.05e-3));
  CHECK_THAT(difference / exact.derivative_w_m2_sr_k * 1000, WithinAbs(-92, 0.5));
}

TEST_CASE("Most of the script's error is the missing last 0.01 um") {
  const double missing = BandRadiance(SpectralResponse::flat(13.99, 14)).radiance(300);
  const double difference = BandRadiance(SpectralResponse::flat(8, 14)).radiance(300) - script_radiance(300);
  CHECK(missing / difference > 0.9);
  CHECK(missing / difference < 1);
}

TEST_CASE("The script's sum is defined at the edges too") {
  CHECK(script_radiance(0) == 0);
  CHECK(script_radiance(-10) == 0);
  CHECK(script_radiance(1) == 0);  // e^1028 overflows, to a radiance of 0
  CHECK(std::isnan(script_radiance(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace script_radiance_test
