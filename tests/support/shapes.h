#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

/// Meshes for tests, in m.
namespace shapes {

using Point = std::array<float, 3>;
using Corners = std::array<std::uint32_t, 3>;

struct Shape {
  std::vector<Point> points_m;
  std::vector<Corners> triangles;
  std::vector<std::uint16_t> materials;  ///< of each triangle
  bool smooth = false;
};

/// All triangles in one material.
inline Shape painted(Shape shape, std::uint16_t material) {
  shape.materials.assign(shape.triangles.size(), material);
  return shape;
}

/// Material `first` + k for triangle k.
inline Shape numbered(Shape shape, std::uint16_t first) {
  shape.materials.clear();
  for (std::size_t k = 0; k < shape.triangles.size(); ++k)
    shape.materials.push_back(static_cast<std::uint16_t>(first + k));
  return shape;
}

inline Shape smoothed(Shape shape) {
  shape.smooth = true;
  return shape;
}

/// The triangles alone, counter-clockwise from outside.
inline Shape of(std::vector<Point> points_m, std::vector<Corners> triangles, std::uint16_t material) {
  return painted({.points_m = std::move(points_m), .triangles = std::move(triangles), .materials = {}},
                 material);
}

/// A square around the z axis, of cells x cells squares of two triangles each. Heights are height_m(x, y), and its
/// outside is above.
template <typename Height>
Shape field(double side_m, std::uint32_t cells, std::uint16_t material, const Height& height_m) {
  Shape shape;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double x = side_m * (static_cast<double>(i) / cells - 0.5);
      const double y = side_m * (static_cast<double>(j) / cells - 0.5);
      shape.points_m.push_back(
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(height_m(x, y))});
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i;
      const std::uint32_t b = a + cells + 1;
      shape.triangles.push_back({a, a + 1, b + 1});
      shape.triangles.push_back({a, b + 1, b});
    }
  }
  return painted(std::move(shape), material);
}

inline Shape level(double side_m, std::uint32_t cells, std::uint16_t material, double height_m = 0) {
  return field(side_m, cells, material, [height_m](double, double) { return height_m; });
}

/// A closed box of 12 triangles between two corners.
inline Shape box(const Point& low_m, const Point& high_m, std::uint16_t material) {
  Shape shape;
  for (unsigned k = 0; k < 8; ++k) {
    shape.points_m.push_back({(k & 1U) != 0 ? high_m[0] : low_m[0], (k & 2U) != 0 ? high_m[1] : low_m[1],
                              (k & 4U) != 0 ? high_m[2] : low_m[2]});
  }
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return painted(std::move(shape), material);
}

inline Shape cube(double side_m, std::uint16_t material) {
  const auto half_m = static_cast<float>(side_m / 2);
  return box({-half_m, -half_m, -half_m}, {half_m, half_m, half_m}, material);
}

/// A closed sphere around (0, 0, height_m): rings x 2 rings squares, of which those at the poles are triangles.
inline Shape ball(double radius_m, std::uint32_t rings, std::uint16_t material, double height_m = 0) {
  const std::uint32_t around = 2 * rings;
  Shape shape;
  const auto add = [&](double x, double y, double z) {
    shape.points_m.push_back({static_cast<float>(radius_m * x), static_cast<float>(radius_m * y),
                              static_cast<float>(height_m + radius_m * z)});
  };
  add(0, 0, -1);
  add(0, 0, 1);
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    const double up_rad = std::numbers::pi * (static_cast<double>(ring) / rings - 0.5);
    for (std::uint32_t k = 0; k < around; ++k) {
      const double turn_rad = 2 * std::numbers::pi * k / around;
      add(std::cos(up_rad) * std::cos(turn_rad), std::cos(up_rad) * std::sin(turn_rad), std::sin(up_rad));
    }
  }
  const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 2 + (ring - 1) * around + k % around; };
  for (std::uint32_t k = 0; k < around; ++k) {
    shape.triangles.push_back({0, at(1, k + 1), at(1, k)});
    for (std::uint32_t ring = 1; ring + 1 < rings; ++ring) {
      shape.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
      shape.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
    }
    shape.triangles.push_back({1, at(rings - 1, k), at(rings - 1, k + 1)});
  }
  return painted(std::move(shape), material);
}

/// Both, as one mesh.
inline Shape joined(Shape one, const Shape& other) {
  const auto first = static_cast<std::uint32_t>(one.points_m.size());
  one.points_m.insert(one.points_m.end(), other.points_m.begin(), other.points_m.end());
  for (const Corners& t : other.triangles)
    one.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  one.materials.insert(one.materials.end(), other.materials.begin(), other.materials.end());
  return one;
}

}  // namespace shapes
