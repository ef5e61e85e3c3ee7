#include "analysis/compare/frame_statistics.h"
#include "support/catch.h"
#include "support/grey_frames.h"

namespace grey_levels_test {

using namespace thermal;
using grey_frames::frame_of;

TEST_CASE("Levels 0 to 99 in equal numbers") {
  const GreyLevels levels = grey_levels(frame_of(100, 40, [](int x, int) { return x; }));
  CHECK_THAT(levels.mean, WithinRel(49.5, 1e-12));
  CHECK_THAT(levels.deviation, WithinRel(28.866070047722118, 1e-12));  // sqrt((100^2 - 1) / 12)
  CHECK(levels.low == 0);
  CHECK(levels.high == 98);
  CHECK(levels.range() == 98);
  CHECK(levels.empty_share == 0);
  CHECK(levels.roughness == 0);
}

TEST_CASE("A comb has empty levels between used ones") {
  const GreyLevels levels = grey_levels(frame_of(101, 40, [](int x, int) { return 2 * x; }));
  CHECK(levels.low == 2);
  CHECK(levels.high == 198);
  CHECK_THAT(levels.empty_share, WithinRel(98.0 / 197.0, 1e-12));
  CHECK_THAT(levels.roughness,
             WithinRel(197.0 / 99.0, 1e-12));  // each step is a count, and half the levels have one
}

TEST_CASE("Levels beyond the percentiles leave no gaps") {
  // One pixel of 4,000 at 250.
  const GreyLevels levels =
      grey_levels(frame_of(100, 40, [](int x, int y) { return x + y == 0 ? 250 : 10 + x % 10; }));
  CHECK(levels.low == 10);
  CHECK(levels.high == 19);
  CHECK(levels.empty_share == 0);
}

TEST_CASE("A frame of one level") {
  const GreyLevels levels = grey_levels(Plane<float>(16, 16, 128.0F));
  CHECK(levels.deviation == 0);
  CHECK(levels.range() == 0);
  CHECK(levels.empty_share == 0);
  CHECK(levels.roughness == 0);
  CHECK(levels.shares[128] == 1);
}

}  // namespace grey_levels_test
