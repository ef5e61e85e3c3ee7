#include "raycast/sight.h"

#include <algorithm>

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

/// The transform of one lane: columns of its rotation and scale, and the rest.
struct Axes {
  Vector3 x;
  Vector3 y;
  Vector3 z;
  Vector3 origin_m;
};

VELDT_INLINE Axes axes_of(const TransformLanes& lanes, std::size_t k) noexcept {
  const double* const m = lanes.data() + k;
  return {.x = {m[0], m[4 * kLanes], m[8 * kLanes]},
          .y = {m[kLanes], m[5 * kLanes], m[9 * kLanes]},
          .z = {m[2 * kLanes], m[6 * kLanes], m[10 * kLanes]},
          .origin_m = {m[3 * kLanes], m[7 * kLanes], m[11 * kLanes]}};
}

VELDT_INLINE Vector3 to_world(const Axes& axes, const Vector3& point) noexcept {
  return point.x * axes.x + point.y * axes.y + point.z * axes.z + axes.origin_m;
}

/// A normal under the inverse transpose, times the determinant.
VELDT_INLINE Vector3 normal_to_world(const Axes& axes, const Vector3& normal) noexcept {
  return normal.x * cross(axes.y, axes.z) + normal.y * cross(axes.z, axes.x) +
         normal.z * cross(axes.x, axes.y);
}

struct Sight {
  Vector3 point_m;
  Vector3 normal;
};

VELDT_INLINE Sight see(const Vector3& ray, const Vector3& a, const Vector3& ab, const Vector3& ac,
                       const Vector3& normal_a, const Vector3& normal_b, const Vector3& normal_c,
                       const Axes& axes) noexcept {
  const Vector3 p = cross(ray, ac);
  const double volume = dot(ab, p);
  const double b = -dot(a, p) / volume;
  const double c = dot(ray, cross(ab, a)) / volume;
  // The comparisons also turn NaN, of a volume of 0, into 0.
  const double share_b = b > 0 ? (b < 1 ? b : 1.0) : 0.0;
  const double rest = 1 - share_b;
  const double share_c = c > 0 ? (c < rest ? c : rest) : 0.0;
  const Vector3 face = cross(ab, ac);
  const Vector3 between = (rest - share_c) * normal_a + share_b * normal_b + share_c * normal_c;
  const Vector3 smooth = normal_to_world(axes, between);
  // A mirror turns the order of corners around and, in `smooth`, the sign of the determinant: both cancel out.
  const bool flat = !(dot(smooth, smooth) > 0);
  const Vector3 normal{flat ? face.x : smooth.x, flat ? face.y : smooth.y, flat ? face.z : smooth.z};
  const double size = length(normal);
  const double side = dot(face, ray) > 0 ? -1.0 : 1.0;
  const double factor = size > 0 ? side / size : 0.0;
  return {.point_m = a + share_b * ab + share_c * ac, .normal = factor * normal};
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

VELDT_CLONES
void see_triangles(const View& view, const VectorLanes<double>& direction, const TriangleLanes& triangle,
                   SightLanes& out) noexcept {
  const View camera = view;  // a copy, which `out` cannot overlap
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Axes axes = axes_of(triangle.to_world, k);
    const Vector3 a = to_world(axes, lane_of(triangle.corner_m[0], k)) - camera.position_m;
    const Vector3 b = to_world(axes, lane_of(triangle.corner_m[1], k)) - camera.position_m;
    const Vector3 c = to_world(axes, lane_of(triangle.corner_m[2], k)) - camera.position_m;
    const Sight sight = see(lane_of(direction, k), a, b - a, c - a, lane_of(triangle.normal[0], k),
                            lane_of(triangle.normal[1], k), lane_of(triangle.normal[2], k), axes);
    at(out.depth_m, k) = static_cast<float>(dot(camera.forward, sight.point_m));
    put_lane(sight.normal, k, out.normal);
  }
}

}  // namespace thermal
