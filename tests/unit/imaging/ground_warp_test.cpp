#include <cmath>
#include <limits>
#include <vector>

#include "imaging/ground/texture.h"
#include "support/catch.h"

namespace ground_warp_test {

using thermal::GroundWarp;

namespace {

/// How far places along a line are moved east.
std::vector<float> moves_m(const GroundWarp& warp, float step_m, float footprint_m, std::size_t count) {
  std::vector<float> x(count);
  std::vector<float> y(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = step_m * static_cast<float>(i) * 0.6F;
    y[i] = step_m * static_cast<float>(i) * 0.8F;
  }
  const std::vector<float> footprint(count, footprint_m);
  std::vector<float> east(count);
  std::vector<float> north(count);
  warp.move(x, y, footprint, east, north);
  for (std::size_t i = 0; i < count; ++i) east[i] -= x[i];
  return east;
}

double deviation(const std::vector<float>& values) {
  double sum = 0;
  double squares = 0;
  for (const float value : values) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value * value);
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(squares / count - sum * sum / (count * count));
}

}  // namespace

TEST_CASE(
    "Places move by 0.12 m, and neighbours of a few centimetres differ: borders are uneven down to the "
    "pixel") {
  const GroundWarp warp(5);
  const std::vector<float> moves = moves_m(warp, 0.06F, 0.04F, 100'000);
  CHECK_THAT(deviation(moves), WithinAbs(0.12, 0.012));
  std::vector<float> steps;
  for (std::size_t i = 1; i < moves.size(); ++i) steps.push_back(moves[i] - moves[i - 1]);
  CHECK(deviation(steps) > 0.012);
  CHECK(deviation(steps) < 0.06);
}

TEST_CASE("Detail finer than a pixel is averaged out, and far pixels do not move") {
  const GroundWarp warp(5);
  CHECK(deviation(moves_m(warp, 0.5F, 1, 10'000)) < 0.1);
  CHECK(deviation(moves_m(warp, 0.5F, 16, 1'000)) < 0.001);
}

TEST_CASE("Places that are none stay where they are") {
  const float x[] = {std::numeric_limits<float>::quiet_NaN(), 1e7F, 1};
  const float y[] = {0, 0, 2};
  const float footprint[] = {0.1F, 0.1F, -1};
  float east[3];
  float north[3];
  GroundWarp(5).move(x, y, footprint, east, north);
  CHECK(std::isnan(east[0]));
  CHECK(north[0] == 0);
  CHECK(east[1] == 1e7F);
  CHECK(east[2] == 1);
  CHECK(north[2] == 2);
}

}  // namespace ground_warp_test
