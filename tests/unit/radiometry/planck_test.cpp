#include "radiometry/planck.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

namespace planck_test {

using namespace thermal;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("Nothing at or below absolute zero radiates") {
  CHECK(planck_radiance(10, 0) == 0);
  CHECK(planck_radiance(10, -0.0) == 0);
  CHECK(planck_radiance(10, -300) == 0);
  CHECK(planck_radiance(10, -kInfinity) == 0);
}

TEST_CASE("A temperature too low for a double gives 0, not an error") {
  CHECK(planck_radiance(10, std::numeric_limits<double>::denorm_min()) == 0);
  CHECK(planck_radiance(10, 1) == 0);  // e^1439
}

TEST_CASE("Limits of Planck's law") {
  CHECK(std::isnan(planck_radiance(10, std::numeric_limits<double>::quiet_NaN())));
  CHECK(planck_radiance(10, kInfinity) == kInfinity);
}

}  // namespace planck_test
