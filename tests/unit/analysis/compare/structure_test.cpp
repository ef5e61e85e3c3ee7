#include <cmath>
#include <numbers>

#include "analysis/compare/frame_statistics.h"
#include "support/catch.h"
#include "support/grey_frames.h"

namespace structure_test {

using namespace thermal;
using grey_frames::frame_of;
using grey_frames::normal;
using grey_frames::white;

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 512;

/// White noise of deviation 4, and rows and columns that differ by themselves.
Plane<float> striped(double rows, double columns) {
  Plane<float> frame = white(kWidth, kHeight, 100, 4);
  const auto of_rows = normal(kHeight, 50);
  const auto of_columns = normal(kWidth, 51);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      frame.at(x, y) += static_cast<float>(rows) * of_rows[static_cast<std::size_t>(y)] +
                        static_cast<float>(columns) * of_columns[static_cast<std::size_t>(x)];
  }
  return frame;
}

/// Noise with round spots of sigma 2 px, on a grid of 40 px: the first `warm` of them warm, all others dark.
Plane<float> spotted(int spots, int warm) {
  constexpr int kGrid = 40;
  const Plane<float> noise = white(kWidth, kHeight, 120, 4);
  return frame_of(kWidth, kHeight, [&](int x, int y) {
    const int number = y / kGrid * (kWidth / kGrid) + x / kGrid;
    const double dx = x % kGrid - kGrid / 2;
    const double dy = y % kGrid - kGrid / 2;
    const double spot = number < spots ? 60 * std::exp(-(dx * dx + dy * dy) / 8) : 0;
    return static_cast<double>(noise.at(x, y)) + (number < warm ? spot : -spot);
  });
}

}  // namespace

TEST_CASE("Rows that differ by themselves show as their variance over that of noise") {
  // The mean square of 510 second differences scatters by 9 %, the logarithm of two by 0.053.
  CHECK_THAT(stripe_excess(striped(0, 0)).value(), WithinAbs(0.0, 0.25));
  const double one = std::log10(1 + kWidth * 0.25 / 16);
  CHECK_THAT(stripe_excess(striped(0.5, 0)).value(), WithinAbs(one, 0.25));
  CHECK_THAT(stripe_excess(striped(0, 0.5)).value(), WithinAbs(-std::log10(1 + kHeight * 0.25 / 16), 0.25));
  CHECK_FALSE(stripe_excess(Plane<float>(64, 64, 90.0F)));
}

TEST_CASE("Warm spots are counted against dark ones") {
  // Of 10,000 independent places, noise is beyond 3 deviations at about 14 on either side.
  CHECK_THAT(spot_balance(white(kWidth, kHeight, 100, 4)), WithinAbs(0.0, 0.3));
  CHECK_THAT(spot_balance(spotted(190, 95)), WithinAbs(0.0, 0.1));
  CHECK(spot_balance(spotted(190, 190)) > 0.5);
  CHECK(spot_balance(spotted(190, 0)) < -0.5);
  CHECK(spot_balance(Plane<float>(64, 64, 90.0F)) == 0);
}

TEST_CASE("Noise has a kurtosis of 3, and one thing among nothing that of its rarity") {
  // The kurtosis of 20,480 values scatters by sqrt(24 / n) = 0.034.
  CHECK_THAT(wavelet_kurtosis(white(kWidth, kHeight, 100, 4)).value(), WithinAbs(3.0, 0.15));
  // One of the 20,480 coefficients of each orientation is not 0: n^-1 / n^-2.
  Plane<float> point(kWidth, kHeight, 100.0F);
  point.at(41, 82) = 180;
  CHECK_THAT(wavelet_kurtosis(point).value(), WithinRel(kWidth / 4.0 * kHeight / 4.0, 1e-9));
  CHECK_FALSE(wavelet_kurtosis(Plane<float>(64, 64, 90.0F)));
}

TEST_CASE("The longest straight line is the side of a block, at any angle, and noise has none") {
  constexpr double kSide = 150;
  for (const double angle_deg : {0.0, 17.0, 45.0, 80.0}) {
    const double angle = angle_deg / 180 * std::numbers::pi;
    const double found = longest_line_px(frame_of(kWidth, kHeight, [angle](int x, int y) {
      const double along = (x - 320) * std::cos(angle) + (y - 256) * std::sin(angle);
      const double across = (y - 256) * std::cos(angle) - (x - 320) * std::sin(angle);
      return std::abs(along) < kSide / 2 && std::abs(across) < 30 ? 160 : 90;
    }));
    CHECK_THAT(found, WithinAbs(kSide, 8));  // corners are round after the blur
  }
  CHECK(longest_line_px(white(kWidth, kHeight, 100, 4)) == 0);
  CHECK(longest_line_px(Plane<float>(16, 16, 90.0F)) == 0);
}

}  // namespace structure_test
