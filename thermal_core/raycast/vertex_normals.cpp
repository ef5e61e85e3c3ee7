#include "raycast/vertex_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "raycast/vectors.h"

namespace thermal {
namespace {

Vector3 unit_or_zero(const Vector3& vector) noexcept {
  const double size = length(vector);
  return size > 0 ? (1 / size) * vector : Vector3();
}

/// Within 2e-8 rad. Arithmetic and square roots alone, because the last bits of std::acos() differ between machines.
/// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.46.
double arc_cosine(double cosine) noexcept {
  constexpr std::array kCoefficients = {-0.0012624911, 0.0066700901, -0.0170881256, 0.0308918810,
                                        -0.0501743046, 0.0889789874, -0.2145988016, 1.5707963050};
  const double size = std::min(std::abs(cosine), 1.0);
  double series = 0;
  for (const double coefficient : kCoefficients) series = series * size + coefficient;
  const double angle_rad = std::sqrt(1 - size) * series;
  return cosine < 0 ? std::numbers::pi - angle_rad : angle_rad;
}

}  // namespace

std::vector<std::array<float, 3>> vertex_normals(const BakedMesh& mesh) {
  std::vector<Vector3> sums(mesh.points_m.size());
  for (const auto& corners : mesh.triangles) {
    std::array<Vector3, 3> point;
    for (std::size_t k = 0; k < 3; ++k) point.at(k) = vector_of(mesh.points_m[corners.at(k)]);
    const Vector3 normal = unit_or_zero(cross(point[1] - point[0], point[2] - point[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 next = unit_or_zero(point.at((k + 1) % 3) - point.at(k));
      const Vector3 last = unit_or_zero(point.at((k + 2) % 3) - point.at(k));
      Vector3& sum = sums[corners.at(k)];
      sum = sum + arc_cosine(dot(next, last)) * normal;
    }
  }
  std::vector<std::array<float, 3>> normals(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k) {
    Vector3 normal = unit_or_zero(sums[k]);
    if (dot(normal, normal) == 0) normal = unit_or_zero(vector_of(mesh.points_m[k]));
    normals[k] = {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)};
  }
  return normals;
}

}  // namespace thermal
