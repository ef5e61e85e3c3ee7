#include <cmath>
#include <cstddef>

#include "raycast/ground_light.h"
#include "support/catch.h"

namespace sky_rays_test {

using Catch::Matchers::WithinAbs;
using thermal::SkyRays;

namespace {

/// 16 shifts at corners and inside of the lattice's cell.
SkyRays::Shift shifts() {
  constexpr float kAlmostOne = 0x1.FFFFFEp-1F;
  SkyRays::Shift shift;
  for (std::size_t k = 0; k < thermal::kLanes; ++k) {
    shift[0][k] = k % 4 == 3 ? kAlmostOne : static_cast<float>(k % 4) / 3;
    shift[1][k] = k / 4 == 3 ? kAlmostOne : static_cast<float>(k / 4) / 3;
  }
  return shift;
}

}  // namespace

TEST_CASE("Rays into the sky are unit vectors above the horizon") {
  for (const std::size_t count : {8U, 55U, 2584U}) {
    const SkyRays rays(count);
    REQUIRE(rays.count() == count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto [x, y, z] = rays.at(k, shifts());
      for (std::size_t lane = 0; lane < thermal::kLanes; ++lane) {
        CHECK_THAT(std::hypot(x[lane], y[lane], z[lane]), WithinAbs(1, 3e-7));
        CHECK(z[lane] >= 0);
      }
    }
  }
}

TEST_CASE("They are spread as the cosine weighs the sky") {
  // A lattice of n points integrates smooth functions to about log(n) / n. The means of cosine weighting: 2/3 of the
  // cosine, 0 of sine times direction, 1/4 of its square.
  const SkyRays rays(987);
  const double tolerance = std::log(987.0) / 987;
  for (const std::size_t lane : {0U, 5U, 15U}) {
    std::array<double, 4> mean{};
    for (std::size_t k = 0; k < rays.count(); ++k) {
      const auto [x, y, z] = rays.at(k, shifts());
      const double east = x[lane];
      mean[0] += static_cast<double>(z[lane]) / 987;
      mean[1] += east / 987;
      mean[2] += static_cast<double>(y[lane]) / 987;
      mean[3] += east * east / 987;
    }
    CHECK_THAT(mean[0], WithinAbs(2.0 / 3, tolerance));
    CHECK_THAT(mean[1], WithinAbs(0, tolerance));
    CHECK_THAT(mean[2], WithinAbs(0, tolerance));
    CHECK_THAT(mean[3], WithinAbs(0.25, tolerance));
  }
}

TEST_CASE("A ray of all lanes stays in one part of the sky") {
  // The lattice's cell has sides of at most 1.16 / sqrt(n) in (u, v); only few rays pass from horizon to zenith.
  const SkyRays rays(89);
  int far = 0;
  for (std::size_t k = 0; k < 89; ++k) {
    const auto [x, y, z] = rays.at(k, shifts());
    far += std::abs(z[0] - z[15]) > 0.5F ? 1 : 0;
  }
  CHECK(far < 20);
}

}  // namespace sky_rays_test
