#include "radiometry/planck.h"

#include "support/catch.h"
#include "support/golden.h"

namespace planck_test {

using namespace thermal;

TEST_CASE("Planck's law agrees with 60-digit arithmetic") {
  for (const GoldenRow& row : read_golden("planck_spectral.csv")) {
    const double wavelength_um = row.numbers[0];
    const double temperature_k = row.numbers[1];
    CAPTURE(wavelength_um, temperature_k);
    // c2, wavelength in m, the product and the quotient round, so x carries 4 roundings of eps / 2 and
    // dL/L = -x dx/x (1 - e^-x)^-1, which for small x is -dx/x: 2 eps (x + 1). The fifth power, expm1 (both
    // within 1 ulp, the power with five times the wavelength's own rounding), c1 and four products: 5 eps more.
    constexpr double kEps = 2.22e-16;
    const double x = kSecondRadiationConstant / (wavelength_um * 1e-6 * temperature_k);
    CHECK_THAT(planck_radiance(wavelength_um, temperature_k), WithinRel(row.numbers[2], (3 * x + 5) * kEps));
  }
}

}  // namespace planck_test
