#include "imaging/ground/warm_spots.h"

#include <limits>

#include "support/catch.h"

namespace warm_spots_test {

using namespace thermal;

namespace {

/// 10 K in the middle, 0 K at twice the half axes.
WarmSpot spot(double x_m, double y_m) { return {.x_m = x_m, .y_m = y_m, .reach = 2, .excess_k = {10, 0}}; }

}  // namespace

TEST_CASE("A spot's excess falls in straight lines to nothing") {
  const WarmSpots spots({spot(5, -3)});
  CHECK(spots.excess_k(5, -3) == 10);
  CHECK_THAT(spots.excess_k(6, -3), WithinAbs(5, 1e-5));
  CHECK_THAT(spots.excess_k(5, -1.5F), WithinAbs(2.5, 1e-5));
  CHECK(spots.excess_k(7, -3) == 0);
  CHECK(spots.excess_k(1e9F, 0) == 0);
  CHECK(spots.excess_k(std::numeric_limits<float>::quiet_NaN(), 0) == 0);
}

TEST_CASE("A spot has a length, a width and a direction") {
  WarmSpot lying = spot(0, 0);
  lying.half_length_m = 2;
  lying.half_width_m = 0.5;
  lying.heading_rad = 0.5 * 3.14159265358979;  // north
  const WarmSpots spots({lying});
  CHECK_THAT(spots.excess_k(0, 2), WithinAbs(5, 1e-4));
  CHECK_THAT(spots.excess_k(0.5F, 0), WithinAbs(5, 1e-4));
  CHECK(spots.excess_k(1.1F, 0) == 0);
  CHECK(spots.excess_k(0, 3.9F) > 0);
}

TEST_CASE("Where spots overlap the warmer one counts, and only ground is warmed") {
  const WarmSpots spots({spot(0, 0), spot(1, 0)});
  CHECK(spots.excess_k(1, 0) == 10);
  const std::uint16_t surface[] = {0, 1, 0};
  const std::int32_t is_ground[] = {1, 0};
  const float x[] = {0, 0, 50};
  const float y[] = {0, 0, 0};
  float temperature_k[] = {280, 280, 280};
  spots.add(surface, is_ground, x, y, temperature_k);
  CHECK(temperature_k[0] == 290);
  CHECK(temperature_k[1] == 280);
  CHECK(temperature_k[2] == 280);
  CHECK(WarmSpots({}).empty());
  CHECK(WarmSpots({}).excess_k(0, 0) == 0);
}

}  // namespace warm_spots_test
