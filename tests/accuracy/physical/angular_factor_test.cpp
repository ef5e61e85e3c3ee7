#include <limits>

#include "radiometry/emissivity.h"
#include "support/catch.h"
#include "support/golden.h"

namespace angular_factor_test {

using namespace thermal;

namespace {

constexpr double kCosine65Deg = 0.42261826174069944;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("Water follows Fresnel's equations, solved independently by Snell's law") {
  const auto rows = read_golden("angular_factor.csv");
  CHECK(rows.size() == 10);
  for (const GoldenRow& row : rows) {
    CAPTURE(row.numbers[0]);
    // The transmitted fraction is one minus reflected squares, with an absolute error of a few eps; about 20
    // operations.
    CHECK_THAT(angular_factor(AngularLaw::water, row.numbers[0]), WithinAbs(row.numbers[1], 5e-15));
  }
}

TEST_CASE("Water loses about 7 % by 65 deg, soil 1 to 3 % by 60 deg, rough surfaces nothing") {
  CHECK_THAT(angular_factor(AngularLaw::water, kCosine65Deg), WithinAbs(0.93, 0.005));  // as printed
  CHECK(angular_factor(AngularLaw::soil, 0.5) >= 0.97);
  CHECK(angular_factor(AngularLaw::soil, 0.5) <= 0.99);
  for (const double cosine : {0.0, 0.3, 1.0}) CHECK(angular_factor(AngularLaw::none, cosine) == 1);
}

TEST_CASE("The factor is 1 at the normal and falls monotonically to the horizon, where water is a mirror") {
  for (const AngularLaw law : {AngularLaw::water, AngularLaw::soil}) {
    double before = angular_factor(law, 1);
    CHECK(before == 1);
    for (int percent = 99; percent >= 0; --percent) {
      const double here = angular_factor(law, percent / 100.0);
      // Within the first degrees water's factor falls with the fourth power of the angle: changes below rounding do
      // not count.
      CHECK(here <= before + std::numeric_limits<double>::epsilon());
      CHECK(here >= 0);
      before = here;
    }
  }
  CHECK_THAT(angular_factor(AngularLaw::water, 0), WithinAbs(0, 5e-15));
  CHECK_THAT(angular_factor(AngularLaw::soil, 0), WithinAbs(0.92, 1e-15));
}

TEST_CASE("Cosines are clamped to [0, 1], and NaN counts as 1") {
  for (const AngularLaw law : {AngularLaw::water, AngularLaw::soil, AngularLaw::none}) {
    CHECK(angular_factor(law, 1.001) == 1);
    CHECK(angular_factor(law, kInfinity) == 1);
    CHECK(angular_factor(law, kNaN) == 1);
    CHECK(angular_factor(law, -0.5) == angular_factor(law, 0));
    CHECK(angular_factor(law, -kInfinity) == angular_factor(law, 0));
  }
}

}  // namespace angular_factor_test
