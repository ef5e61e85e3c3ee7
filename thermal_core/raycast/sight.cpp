#include "raycast/sight.h"

#include <algorithm>

namespace thermal {
namespace {

/// Columns of a transform's rotation and scale.
struct Axes {
  explicit Axes(const Transform<double>& m) noexcept
      : x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]} {}

  [[nodiscard]] bool mirror() const noexcept { return dot(cross(x, y), z) < 0; }

  /// A normal under the inverse transpose, times a positive number.
  [[nodiscard]] Vector3 turned(const Vector3& normal) const noexcept {
    const Vector3 turned = normal.x * cross(y, z) + normal.y * cross(z, x) + normal.z * cross(x, y);
    return mirror() ? -1.0 * turned : turned;
  }

  Vector3 x;
  Vector3 y;
  Vector3 z;
};

}  // namespace

Vector3 transformed(const Transform<double>& m, const std::array<float, 3>& point) noexcept {
  const Vector3 p = vector_of(point);
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

Sight see_triangle(const Vector3& ray, const PlacedTriangle& triangle,
                   const Transform<double>& to_world) noexcept {
  const Vector3& a = triangle.corner_m[0];
  const Vector3 ab = triangle.corner_m[1] - a;
  const Vector3 ac = triangle.corner_m[2] - a;
  const Vector3 p = cross(ray, ac);
  const double volume = dot(ab, p);
  const double b = -dot(a, p) / volume;
  const double c = dot(ray, cross(ab, a)) / volume;
  // Rounding may put the point beside an edge. The comparisons also turn NaN, of a volume of 0, into 0.
  const double share_b = b > 0 ? std::min(b, 1.0) : 0.0;
  const double share_c = c > 0 ? std::min(c, 1.0 - share_b) : 0.0;
  const Axes axes(to_world);
  const Vector3 face = axes.mirror() ? cross(ac, ab) : cross(ab, ac);
  Vector3 normal = face;
  if (triangle.smooth) {
    normal = axes.turned((1 - share_b - share_c) * triangle.normal[0] + share_b * triangle.normal[1] +
                         share_c * triangle.normal[2]);
  }
  const double size = length(normal);
  const double towards_camera = dot(face, ray) > 0 ? -1 : 1;
  return {.point_m = a + share_b * ab + share_c * ac,
          .normal = size > 0 ? (towards_camera / size) * normal : Vector3()};
}

}  // namespace thermal
