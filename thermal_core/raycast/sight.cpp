#include "raycast/sight.h"

#include <cmath>
#include <limits>

#include "base/clones.h"

namespace thermal {
namespace {

// By pointer: GCC 12 does not vectorise loops over elements of a std::array in a structure.
template <typename Number>
VELDT_INLINE Number& at(Lanes<Number>& lanes, std::size_t k) noexcept {
  return *(lanes.data() + k);
}
template <typename Number>
VELDT_INLINE const Number& at(const Lanes<Number>& lanes, std::size_t k) noexcept {
  return *(lanes.data() + k);
}

template <typename Number>
VELDT_INLINE Vector3 lane_of(const VectorLanes<Number>& lanes, std::size_t k) noexcept {
  return {static_cast<double>(at(lanes[0], k)), static_cast<double>(at(lanes[1], k)),
          static_cast<double>(at(lanes[2], k))};
}

template <typename Number>
VELDT_INLINE void put_lane(const Vector3& vector, std::size_t k, VectorLanes<Number>& lanes) noexcept {
  at(lanes[0], k) = static_cast<Number>(vector.x);
  at(lanes[1], k) = static_cast<Number>(vector.y);
  at(lanes[2], k) = static_cast<Number>(vector.z);
}

/// Columns of a transform: its linear part, and its translation.
struct Axes {
  Vector3 x;
  Vector3 y;
  Vector3 z;
  Vector3 origin_m;
};

Axes axes_of(const std::array<double, 12>& m) noexcept {
  return {.x = {m[0], m[4], m[8]},
          .y = {m[1], m[5], m[9]},
          .z = {m[2], m[6], m[10]},
          .origin_m = {m[3], m[7], m[11]}};
}

Vector3 to_world(const Axes& axes, const Vector3& point) noexcept {
  return point.x * axes.x + point.y * axes.y + point.z * axes.z + axes.origin_m;
}

/// A normal transformed by the inverse transpose, times the determinant.
Vector3 normal_to_world(const Axes& axes, const Vector3& normal) noexcept {
  return normal.x * cross(axes.y, axes.z) + normal.y * cross(axes.z, axes.x) +
         normal.z * cross(axes.x, axes.y);
}

/// Clamps a barycentric coordinate to [0, rest]. The comparisons also turn NaN, of a ray in the plane, into 0.
VELDT_INLINE double share_of(double share, double rest) noexcept {
  return share > 0 ? (share < rest ? share : rest) : 0.0;
}

}  // namespace

VELDT_CLONES
VectorLanes<double> directions(const View& view, const Lanes<double>& x, const Lanes<double>& y) noexcept {
  VectorLanes<double> out;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
  for (std::size_t k = 0; k < kLanes; ++k)
    put_lane(at(x, k) * view.right + at(y, k) * view.down + view.forward, k, out);
  return out;
}

VELDT_CLONES
UnitLanes units(const VectorLanes<double>& direction) noexcept {
  UnitLanes out;  // NOLINT(cppcoreguidelines-pro-type-member-init): all lanes are filled in
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vector3 ray = lane_of(direction, k);
    const double size = length(ray);
    at(out.length, k) = size;
    put_lane({ray.x / size, ray.y / size, ray.z / size}, k, out.direction);
  }
  return out;
}

TriangleSight sight_of(const View& view, const std::array<double, 12>& transform,
                       const std::array<Vector3, 3>& corner_m,
                       const std::array<Vector3, 3>& normal) noexcept {
  const Axes axes = axes_of(transform);
  const Vector3 a = to_world(axes, corner_m[0]) - view.position_m;
  const Vector3 ab = to_world(axes, corner_m[1]) - view.position_m - a;
  const Vector3 ac = to_world(axes, corner_m[2]) - view.position_m - a;
  const Vector3 face = cross(ab, ac);
  return {.face = face,
          .b = cross(ac, a),
          .c = cross(a, ab),
          .volume = dot(a, face),
          .depth_m = {dot(view.forward, a), dot(view.forward, ab), dot(view.forward, ac)},
          .normal = {normal_to_world(axes, normal[0]), normal_to_world(axes, normal[1]),
                     normal_to_world(axes, normal[2])}};
}

double distance_along(const Vector3& ray, const TriangleSight& triangle) noexcept {
  const double distance = triangle.volume / dot(ray, triangle.face);
  return std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
}

void put_lane(const TriangleSight& triangle, std::size_t lane, TriangleLanes& out) noexcept {
  put_lane(triangle.face, lane, out.face);
  put_lane(triangle.b, lane, out.b);
  put_lane(triangle.c, lane, out.c);
  for (std::size_t which = 0; which < 3; ++which) {
    out.depth_m[which][lane] = triangle.depth_m[which];
    put_lane(triangle.normal[which], lane, out.normal[which]);
  }
}

VELDT_CLONES
void see_triangles(const VectorLanes<double>& direction, const TriangleLanes& triangle,
                   SightLanes& out) noexcept {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vector3 ray = lane_of(direction, k);
    const Vector3 face = lane_of(triangle.face, k);
    const double slope = dot(ray, face);
    const double b = share_of(dot(ray, lane_of(triangle.b, k)) / slope, 1.0);
    const double c = share_of(dot(ray, lane_of(triangle.c, k)) / slope, 1 - b);
    const double a = 1 - b - c;
    at(out.depth_m, k) = static_cast<float>(at(triangle.depth_m[0], k) + b * at(triangle.depth_m[1], k) +
                                            c * at(triangle.depth_m[2], k));
    // A mirror reverses the order of corners and, in `smooth`, the sign of the determinant: both cancel out.
    const Vector3 smooth = a * lane_of(triangle.normal[0], k) + b * lane_of(triangle.normal[1], k) +
                           c * lane_of(triangle.normal[2], k);
    const bool flat = !(dot(smooth, smooth) > 0);
    const Vector3 normal{flat ? face.x : smooth.x, flat ? face.y : smooth.y, flat ? face.z : smooth.z};
    const double size = length(normal);
    const double side = slope > 0 ? -1.0 : 1.0;
    const double factor = size > 0 ? side / size : 0.0;
    put_lane(factor * normal, k, out.normal);
  }
}

}  // namespace thermal
