#include "raycast/sight.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "support/catch.h"

namespace sight_test {

using thermal::kLanes;
using thermal::SightLanes;
using thermal::TriangleLanes;
using Point = std::array<double, 3>;

namespace {

constexpr Point kA = {0, 0, 4};
constexpr Point kB = {2, 0, 5};
constexpr Point kC = {0, 2, 6};

/// A camera in the origin that looks along z, with x to the right.
constexpr thermal::View kView = {
    .right = {1, 0, 0}, .down = {0, 1, 0}, .forward = {0, 0, 1}, .position_m = {}};

constexpr std::array<double, 12> kInPlace = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// Corners of a triangle, and normals there.
struct Triangle {
  std::array<Point, 3> corner_m = {kA, kB, kC};
  std::array<Point, 3> normal{};
};

std::array<thermal::Vector3, 3> vectors(const std::array<Point, 3>& points) {
  return {thermal::vector_of(points[0]), thermal::vector_of(points[1]), thermal::vector_of(points[2])};
}

/// One triangle in each lane.
TriangleLanes lanes_of(const std::array<Triangle, kLanes>& triangles) {
  TriangleLanes lanes{};
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Triangle& triangle = triangles.at(k);
    put_lane(sight_of(kView, kInPlace, vectors(triangle.corner_m), vectors(triangle.normal)), k, lanes);
  }
  return lanes;
}

/// What rays of these directions see of it.
SightLanes seen(const std::array<Point, kLanes>& directions,
                const std::array<Triangle, kLanes>& triangles = {}) {
  thermal::VectorLanes<double> rays{};
  for (std::size_t k = 0; k < kLanes; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) rays.at(axis).at(k) = directions.at(k).at(axis);
  SightLanes sights;
  thermal::see_triangles(rays, lanes_of(triangles), sights);
  return sights;
}

/// The direction of a point, one unit along the camera's axis.
Point towards(const Point& point) { return {point[0] / point[2], point[1] / point[2], 1}; }

/// A + b (B - A) + c (C - A)
Point between(double b, double c) {
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.at(axis) = kA.at(axis) + b * (kB.at(axis) - kA.at(axis)) + c * (kC.at(axis) - kA.at(axis));
  return point;
}

}  // namespace

TEST_CASE("Each ray sees its own point of the triangle") {
  std::array<Point, kLanes> directions{};
  for (std::size_t k = 0; k < kLanes; ++k)
    directions.at(k) = towards(between(0.05 * static_cast<double>(k), 0.01 * static_cast<double>(k)));
  const SightLanes sights = seen(directions);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double depth_m = 4 + 0.05 * static_cast<double>(k) + 0.02 * static_cast<double>(k);
    CHECK_THAT(static_cast<double>(sights.depth_m.at(k)), WithinRel(depth_m, 6e-8));  // rounded once
    // The normal is that of 1, 2, -2 (z = 4 + x / 2 + y), towards the camera.
    CHECK_THAT(static_cast<double>(sights.normal[0].at(k)), WithinAbs(1 / 3.0, 3e-8));
    CHECK_THAT(static_cast<double>(sights.normal[1].at(k)), WithinAbs(2 / 3.0, 3e-8));
    CHECK_THAT(static_cast<double>(sights.normal[2].at(k)), WithinAbs(-2 / 3.0, 3e-8));
  }
}

TEST_CASE("Rays beside the triangle see its border") {
  // Beside A, B and C, then beside the sides.
  std::array<Point, kLanes> directions;
  directions.fill({0.1, 0.1, 1});
  directions[0] = towards(between(-0.1, -0.2));
  directions[1] = towards(between(1.3, -0.1));
  directions[2] = towards(between(-0.1, 1.2));
  directions[3] = towards(between(0.5, -0.1));
  directions[4] = towards(between(-0.1, 0.5));
  directions[5] = towards(between(0.5, 0.6));
  const SightLanes sights = seen(directions);
  CHECK(sights.depth_m[0] == 4);
  CHECK(sights.depth_m[1] == 5);
  CHECK(sights.depth_m[2] == 6);
  CHECK(sights.depth_m[3] == 4.5F);
  CHECK(sights.depth_m[4] == 5);
  CHECK(sights.depth_m[5] == 5.5F);
}

TEST_CASE("A ray in the triangle's plane sees a corner") {
  // Through the camera: the plane of (0, 0, 4), (2, 0, 5) and (4, 0, 9).
  std::array<Triangle, kLanes> triangles;
  triangles[0].corner_m[2] = {4, 0, 9};
  std::array<Point, kLanes> directions;
  directions.fill({0.2, 0, 1});
  const SightLanes sights = seen(directions, triangles);
  CHECK(sights.depth_m[0] == 4);
  CHECK_THAT(std::abs(static_cast<double>(sights.normal[1][0])), WithinAbs(1, 3e-8));
}

TEST_CASE(
    "Smooth triangles have normals between those of their corners, flat ones and those without any their "
    "own") {
  std::array<Triangle, kLanes> triangles;
  for (const std::size_t lane : {0U, 1U})
    triangles.at(lane).normal = {Point{0, 0, -1}, Point{1, 0, 0}, Point{0, 1, 0}};
  triangles[2].normal = {Point{0, 0, -1}, Point{}, Point{0, 0, 1}};  // cancel out halfway between A and C
  std::array<Point, kLanes> directions;
  directions.fill(towards(between(0.25, 0.25)));
  directions[1] = towards(between(0, 0.5));
  directions[2] = towards(between(0, 0.5));
  const SightLanes sights = seen(directions, triangles);
  // The triangle's front faces away from the camera, so that (0.25, 0.25, -0.5) is turned around.
  const double size = std::sqrt(0.375);
  CHECK_THAT(static_cast<double>(sights.normal[0][0]), WithinAbs(-0.25 / size, 4e-8));
  CHECK_THAT(static_cast<double>(sights.normal[1][0]), WithinAbs(-0.25 / size, 4e-8));
  CHECK_THAT(static_cast<double>(sights.normal[2][0]), WithinAbs(0.5 / size, 4e-8));
  CHECK(sights.normal[0][1] == 0);
  CHECK_THAT(static_cast<double>(sights.normal[2][2]), WithinAbs(-2 / 3.0, 3e-8));
  CHECK_THAT(static_cast<double>(sights.normal[2][3]), WithinAbs(-2 / 3.0, 3e-8));
}

}  // namespace sight_test
