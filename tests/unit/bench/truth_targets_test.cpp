#include <cmath>
#include <numbers>

#include "bench/truth/targets.h"
#include "support/catch.h"

namespace truth_targets_test {

using namespace thermal;

namespace {

double area_px2(const std::vector<TruthShape>& shapes, int per_px) {
  double area = 0;
  for (int line = -10 * per_px; line < 10 * per_px; ++line) {
    for (const TruthStretch& stretch : stretches_between(shapes, static_cast<double>(line) / per_px,
                                                         static_cast<double>(line + 1) / per_px))
      area += stretch.share * (stretch.end_px - stretch.begin_px) / per_px;
  }
  return area;
}

}  // namespace

TEST_CASE("lines hold the whole area of an ellipse, however few they are") {
  const std::vector<TruthShape> ellipse = {{.x = 0.3, .y = 0.2, .half_x = 3, .half_y = 1.7}};
  for (const int per_px : {1, 3, 32})
    CHECK_THAT(area_px2(ellipse, per_px), WithinRel(std::numbers::pi * 3 * 1.7, 1e-12));
}

TEST_CASE("shapes that overlap are one stretch of a line") {
  const std::vector<TruthShape> shapes = {{.is_ellipse = false, .x = 0}, {.is_ellipse = false, .x = 1.5}};
  CHECK_THAT(area_px2(shapes, 4), WithinRel(3.5 * 2, 1e-12));
  CHECK(is_inside(shapes, 2.4, 0.9));
  CHECK_FALSE(is_inside(shapes, 2.6, 0));
  const TruthShape box = bounds_of(shapes);
  CHECK_THAT(box.x - box.half_x, WithinAbs(-1, 1e-15));
  CHECK_THAT(box.x + box.half_x, WithinAbs(2.5, 1e-15));
}

TEST_CASE("a small target's signal is its area times its contrast") {
  const std::vector<TruthTarget> targets = truth_targets();
  const TruthTarget dot = truth_target(targets, "0.3 px");
  const TruthSteps steps = {.lines_per_px = 16, .radius_px = 24};
  const ContrastKernel kernel({.gaussian_sigma_px = 0.6}, dot.surface, {278, 0.914}, steps);
  const Plane<double> image = true_radiance(kernel, placed(dot, 1, 10.37, 9.81), 20, 20, 20);
  double signal = 0;
  for (const double value : image.pixels()) signal += value - 20;
  CHECK_THAT(signal,
             WithinRel(0.09 * kernel.contrast_w_m2_sr(), 1e-3));  // a Gaussian's alias at 1 cycle per px
}

TEST_CASE("as many rays as there are lines see what the lines see") {
  const std::vector<TruthTarget> targets = truth_targets();
  const TruthTarget person = truth_target(targets, "person");
  const ContrastKernel kernel({}, person.surface, {278, 0.914}, {.radius_px = 24});
  const std::vector<TruthShape> shapes = placed(person, 6.27, 9.3, 8.6);
  const Plane<double> lines = true_radiance(kernel, shapes, 20, 18, 17);
  const Plane<double> rays = true_radiance(kernel, shapes, 20, 18, 17, 32);
  double worst = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    worst = std::max(worst, std::abs(lines.pixels()[i] - rays.pixels()[i]));
  CHECK(worst < 0.01 * kernel.contrast_w_m2_sr());
  CHECK(worst > 0);
}

}  // namespace truth_targets_test
