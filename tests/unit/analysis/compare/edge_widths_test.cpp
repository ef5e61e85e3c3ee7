#include "analysis/compare/edge_widths.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/grey_frames.h"

namespace edge_widths_test {

using namespace thermal;
using grey_frames::frame_of;

namespace {

/// A step from 60 to 160 across a line through the middle, blurred by a Gaussian.
Plane<float> blurred_step(double deviation_px, double angle_deg, double noise = 0) {
  const double angle = angle_deg / 180 * std::numbers::pi;
  Plane<float> frame = frame_of(160, 128, [&](int x, int y) {
    const double across = (x - 80.3) * std::cos(angle) + (y - 64.1) * std::sin(angle);
    return 110 + 50 * std::erf(across / deviation_px / std::numbers::sqrt2);
  });
  const std::vector<float> added = grey_frames::normal(frame.size(), 3);
  for (std::size_t k = 0; k < added.size(); ++k)
    frame.pixels()[k] =
        static_cast<float>(static_cast<double>(frame.pixels()[k]) + noise * static_cast<double>(added[k]));
  return frame;
}

/// Between the 10th and the 90th percentile of the normal distribution.
constexpr double kWidth = 2.5631031310892;

}  // namespace

TEST_CASE("The width of a blurred step is that of its Gaussian, at any angle") {
  // Log-odds of a Gaussian are straight within 2 %, and bins of half a pixel widen a blur of 1 px by 1 %.
  for (const double angle_deg : {0.0, 20.0, 45.0, 90.0, 130.0, 200.0}) {
    for (const double deviation_px : {1.0, 1.5, 2.0}) {
      const std::vector<double> widths = edge_widths_px(blurred_step(deviation_px, angle_deg));
      REQUIRE(widths.size() >= 3);
      for (const double width : widths) CHECK_THAT(width, WithinRel(kWidth * deviation_px, 0.04));
    }
  }
}

TEST_CASE("A wide edge is understated, because its sides are not level yet") {
  for (const double width : edge_widths_px(blurred_step(3, 20)))
    CHECK_THAT(width, WithinRel(kWidth * 3, 0.08));
  for (const double width : edge_widths_px(blurred_step(9, 20))) CHECK(width < 0.7 * kWidth * 9);
}

TEST_CASE("Noise widens no edge by much") {
  const std::vector<double> widths = edge_widths_px(blurred_step(1.5, 20, 2));
  REQUIRE(widths.size() >= 3);
  for (const double width : widths) CHECK_THAT(width, WithinRel(kWidth * 1.5, 0.15));
}

TEST_CASE("No edges: a level frame, a wave, a frame too small") {
  CHECK(edge_widths_px(Plane<float>(160, 128, 90.0F)).empty());
  CHECK(edge_widths_px(frame_of(160, 128, [](int x, int) { return 100 + 50 * std::sin(0.7 * x); })).empty());
  CHECK(edge_widths_px(frame_of(16, 16, [](int x, int) { return x < 8 ? 0 : 100; })).empty());
}

TEST_CASE("No more edges than the limit") {
  const auto stripes = frame_of(640, 512, [](int x, int) { return x / 40 % 2 == 0 ? 50 : 150; });
  CHECK(edge_widths_px(stripes).size() == kMostEdges);
}

}  // namespace edge_widths_test
