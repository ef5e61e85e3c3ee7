#include "raycast/pixel_rays.h"
#include "support/catch.h"

namespace lens_range_test {

using thermal::LensDistortion;
using thermal::LensPoint;
using thermal::LensRange;

namespace {

constexpr int kSteps = 24;

/// Points of a range, its corners among them.
template <typename Look>
void each_point(const LensRange& range, const Look& look) {
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      look(LensPoint{range.least.x + (range.most.x - range.least.x) * i / kSteps,
                     range.least.y + (range.most.y - range.least.y) * j / kSteps});
    }
  }
}

const std::vector<LensDistortion> kLenses = {{},
                                             {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.0005},
                                             {.k1 = 0.3, .k2 = -0.1, .p1 = -0.02, .p2 = 0.01, .k3 = 0.02},
                                             {.k1 = -0.9, .k2 = 2, .k3 = -3}};

}  // namespace

TEST_CASE("A range behind a lens holds what the lens shows of the range's points") {
  for (const LensDistortion& lens : kLenses) {
    for (const double x : {-0.8, -0.3, -0.01, 0.2}) {
      for (const double y : {-0.6, -0.02, 0.4}) {
        for (const double size : {0.0, 0.05, 0.5}) {
          const LensRange range = {.least = {x, y}, .most = {x + size, y + 0.7 * size}};
          const LensRange shown = distort(lens, range);
          each_point(range, [&](const LensPoint& point) {
            const LensPoint there = distort(lens, point);
            constexpr double kRounding = 1e-14;
            CHECK(there.x >= shown.least.x - kRounding);
            CHECK(there.x <= shown.most.x + kRounding);
            CHECK(there.y >= shown.least.y - kRounding);
            CHECK(there.y <= shown.most.y + kRounding);
          });
        }
      }
    }
  }
}

TEST_CASE("A range behind a lens is hardly too wide") {
  constexpr double kSize = 0.06;  // of a person 30 m away
  const LensDistortion lens = {.k1 = -0.2};
  const LensRange range = {.least = {0.4, 0.1}, .most = {0.4 + kSize, 0.1 + kSize}};
  LensRange least;
  each_point(range, [&](const LensPoint& point) { least.add(distort(lens, point)); });
  const LensRange shown = distort(lens, range);
  // On each side: x times how much the other factor, 1 + k1 r^2, changes over the range: 0.46 * 0.2 * 0.066.
  CHECK(shown.least.x > least.least.x - 0.11 * kSize);
  CHECK(shown.most.x < least.most.x + 0.11 * kSize);
}

TEST_CASE("A pinhole's range stays as it is") {
  const LensRange range = {.least = {-0.25, 0.5}, .most = {0.75, 1}};
  const LensRange shown = distort({}, range);
  CHECK(shown.least.x == -0.25);
  CHECK(shown.least.y == 0.5);
  CHECK(shown.most.x == 0.75);
  CHECK(shown.most.y == 1);
}

TEST_CASE("Ranges without a common point share an empty one") {
  const LensRange left = {.least = {0, 0}, .most = {1, 1}};
  CHECK(common(left, {.least = {2, 0}, .most = {3, 1}}).is_empty());
  CHECK(common(left, {}).is_empty());
  CHECK(LensRange().is_empty());
  const LensRange corner = common(left, {.least = {1, 1}, .most = {3, 3}});
  CHECK_FALSE(corner.is_empty());
  CHECK(corner.least.x == 1);
  CHECK(corner.most.y == 1);
}

}  // namespace lens_range_test
