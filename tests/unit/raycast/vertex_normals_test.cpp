#include "raycast/vertex_normals.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.h"
#include "support/ray_truth.h"

namespace vertex_normals_test {

using shapes::Point;
using shapes::Shape;

namespace {

std::vector<Point> normals_of(const Shape& shape) {
  return thermal::vertex_normals({.name = {},
                                  .smooth = true,
                                  .points_m = shape.points_m,
                                  .triangles = shape.triangles,
                                  .material_index = shape.materials});
}

/// The largest difference from the truth in any coordinate.
double worst(const Shape& shape) {
  const std::vector<Point> found = normals_of(shape);
  const std::vector<ray_truth::Vector> wanted = ray_truth::point_normals(shape);
  REQUIRE(found.size() == wanted.size());
  double most = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const ray_truth::Vector off = ray_truth::vector_of(found[k]) - wanted[k];
    most = std::max({most, std::abs(static_cast<double>(off.x)), std::abs(static_cast<double>(off.y)),
                     std::abs(static_cast<double>(off.z))});
  }
  return most;
}

// Rounding to single precision: 3e-8 of a number near 1. The polynomial for the angles adds up to 2e-8 rad for each of
// the triangles around a point; in these meshes at most 12, of which 0.5 rad and more are left in the sum.
constexpr double kTolerance = 3e-8 + 12 * 2e-8 / 0.5;

}  // namespace

TEST_CASE("The normals of points are the means of those around, weighted by angles") {
  CHECK(worst(shapes::ball(1, 6, 1)) < kTolerance);
  CHECK(worst(shapes::ball(300, 3, 1, 1000)) < kTolerance);
  CHECK(worst(shapes::box({-1, -2, -3}, {5, 1, 0.5}, 1)) < kTolerance);
  CHECK(worst(shapes::field(20, 9, 1, [](double x, double y) {
          return std::sin(x) + 0.3 * y * std::cos(x * y);
        })) < kTolerance);
  CHECK(worst(shapes::of({{0, 0, 0}, {1, 0, 0}, {-9, 0.5F, 0}, {0.1F, -1, 2}}, {{0, 1, 2}, {0, 3, 1}}, 1)) <
        kTolerance);
}

TEST_CASE(
    "A corner of a cube has the normal of its diagonal, whether its sides have one triangle there or two") {
  const Shape cube = shapes::cube(2, 1);
  const double third = 1 / std::numbers::sqrt3;
  const std::vector<Point> normals = normals_of(cube);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      CHECK_THAT(static_cast<double>(normals[k].at(axis)),
                 WithinAbs(cube.points_m[k].at(axis) > 0 ? third : -third, kTolerance));
  }
}

TEST_CASE("Degenerate triangles count for nothing") {
  Shape shape = shapes::of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}}, 1);
  const std::vector<Point> plain = normals_of(shape);
  for (const shapes::Corners& corners :
       {shapes::Corners{0, 0, 1}, {2, 2, 2}, {1, 0, 0}, {0, 1, 3}, {1, 3, 4}})
    shape.triangles.push_back(corners);
  CHECK(normals_of(shape)[0] == plain[0]);
  CHECK(normals_of(shape)[2] == plain[2]);
  CHECK(plain[0] == Point{0, 0, 1});
  CHECK(normals_of(shape)[3] == Point{1, 0, 0});  // from the origin
}

TEST_CASE("Points of no triangle have the direction from the origin, and the origin none") {
  const std::vector<Point> normals = normals_of(shapes::of({{0, 0, -5}, {0, 3, 4}, {0, 0, 0}}, {}, 1));
  CHECK(normals == std::vector<Point>{{0, 0, -1}, {0, 0.6F, 0.8F}, {0, 0, 0}});
  CHECK(normals_of({}).empty());
}

TEST_CASE("Opposite triangles leave the direction from the origin") {
  // The same triangle from both sides: sums are zero, exactly.
  const std::vector<Point> normals =
      normals_of(shapes::of({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 1, 2}, {0, 2, 1}}, 1));
  CHECK(normals == std::vector<Point>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
}

TEST_CASE("Weights are the angles, from slender triangles to stretched ones") {
  // Beside a right angle in another plane. Two weights are off by up to 2e-8 rad, of 1.57 rad and more; 3e-8 is the
  // rounding to single precision.
  for (double angle_rad = 1e-7; angle_rad < 3.1; angle_rad = 1.01 * angle_rad + 1e-7) {
    const auto x = static_cast<float>(std::cos(angle_rad));
    const auto y = static_cast<float>(std::sin(angle_rad));
    const Shape shape =
        shapes::of({{0, 0, 0}, {1, 0, 0}, {x, y, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 4}}, 1);
    INFO("angle " << angle_rad << " rad");
    CHECK(worst(shape) < 3e-8 + 2e-8 * std::numbers::sqrt2 / 1.57);
  }
}

}  // namespace vertex_normals_test
