#pragma once

#include <array>
#include <cstdint>

#include "raycast/vectors.h"
#include "scene/baked_scene.h"

namespace thermal {

/// A triangle of a mesh in its position.
struct PlacedTriangle {
  std::array<Vector3, 3> corner_m;  ///< relative to the camera, in world axes
  std::array<Vector3, 3> normal;    ///< of a smooth mesh's points, in the mesh's axes
  bool smooth = false;
};

/// What a ray sees of the triangle that it hits.
struct Sight {
  Vector3 point_m;  ///< relative to the camera, in world axes
  Vector3 normal;   ///< unit, towards the camera
};

/// A point under a transform.
[[nodiscard]] Vector3 transformed(const Transform<double>& to_world,
                                  const std::array<float, 3>& point) noexcept;

/// Where a ray from the camera meets a triangle that it is known to hit, within rounding. Double precision, in one
/// order, so that bits do not depend on the machine. A ray in the triangle's plane gets one of its corners.
/// Of a smooth mesh: the normal between those of the corners, as Cycles has it, also where that faces away.
/// Source: T. Möller and B. Trumbore, Fast, minimum storage ray-triangle intersection, J. Graphics Tools 2(1), 1997.
[[nodiscard]] Sight see_triangle(const Vector3& ray, const PlacedTriangle& triangle,
                                 const Transform<double>& to_world) noexcept;

}  // namespace thermal
