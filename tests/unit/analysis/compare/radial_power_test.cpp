#include <cmath>
#include <numbers>

#include "analysis/compare/frame_statistics.h"
#include "support/catch.h"
#include "support/grey_frames.h"

namespace radial_power_test {

using namespace thermal;
using grey_frames::frame_of;
using grey_frames::white;

namespace {

/// Of white noise, at every frequency: the variance times the sum of the squared window, which for Hann's is 3/8 of the
/// pixels less one along each side, scaled to 640 x 512 px.
double expected_power(double deviation, int width_px, int height_px) {
  const double window = 9.0 / 64.0 * (width_px - 1) * (height_px - 1);
  return deviation * deviation * window * 640 * 512 / (width_px * height_px);
}

}  // namespace

TEST_CASE("White noise has the same power in every band, whatever the frame's size") {
  // The finest band of 256 x 256 px holds 26,000 frequencies; mirrored halves and the window, which joins 3.8 neighbours,
  // leave 3,500 independent powers, exponentially distributed: the mean scatters by 1.7 %. Of the other bands it
  // scatters by up to 20 % (0.02 to 0.04: 240 frequencies, 32 independent). Bounds at five deviations.
  for (const auto& [width_px, height_px] : {std::pair(256, 256), {320, 200}, {640, 512}}) {
    const RadialPower power = radial_power(white(width_px, height_px, 100, 3));
    const double expected = expected_power(3, width_px, height_px);
    CHECK_THAT(power.bands[kBands - 1], WithinRel(expected, 0.09));
    CHECK_THAT(power.bands[4], WithinRel(expected, 0.25));
  }
}

TEST_CASE("A wave lies in the band of its frequency alone") {
  const RadialPower power = radial_power(frame_of(256, 256, [](int x, int y) {
    return 100 + 20 * std::cos(2 * std::numbers::pi * 0.2 * (0.6 * x + 0.8 * y));
  }));
  double others = 0;
  for (std::size_t band = 0; band < kBands; ++band) others += band == 5 ? 0 : power.bands[band];
  CHECK(power.bands[5] > 1e6 * others);
}

TEST_CASE("A level frame has no power, and a frame's level adds none") {
  for (const double power : radial_power(Plane<float>(64, 64, 7.0F)).bands) CHECK(power == 0);
  const RadialPower dark = radial_power(white(64, 64, 10, 3));
  const RadialPower bright = radial_power(white(64, 64, 200, 3));
  for (std::size_t band = 3; band < kBands; ++band)
    CHECK_THAT(bright.bands[band], WithinRel(dark.bands[band], 1e-4));  // levels are rounded to 24 bits
}

TEST_CASE("Bands that a small frame cannot resolve are 0") {
  const RadialPower power = radial_power(white(32, 32, 100, 3));
  CHECK(power.bands[0] == 0);
  CHECK(power.bands[1] == 0);
  CHECK(power.bands[2] > 0);
}

}  // namespace radial_power_test
