#pragma once

#include <array>
#include <cstddef>

#include "raycast/vectors.h"

namespace thermal {

/// Rays that are computed together.
inline constexpr std::size_t kLanes = 16;
/// A number for each of the rays.
template <typename Number>
using Lanes = std::array<Number, kLanes>;

/// A vector per lane.
template <typename Number>
using VectorLanes = std::array<Lanes<Number>, 3>;

/// Directions of rays through pixels, in world axes, of length 1 along the camera's axis.
[[nodiscard]] VectorLanes<double> directions(const View& view, const Lanes<double>& x,
                                             const Lanes<double>& y) noexcept;

/// Unit vectors of directions, and their lengths.
struct UnitLanes {
  VectorLanes<float> direction;
  Lanes<double> length;
};
/// Normalises directions.
[[nodiscard]] UnitLanes units(const VectorLanes<double>& direction) noexcept;

/// A triangle prepared for intersection with rays from the camera: corners a, a + ab, a + ac relative to the camera, in
/// world axes.
struct TriangleSight {
  Vector3 face;       ///< ab x ac
  Vector3 b;          ///< ac x a: the share of ab at a ray's point is (ray . b) / (ray . face)
  Vector3 c;          ///< a x ab, likewise
  double volume = 0;  ///< a . face: a ray meets the plane at volume / (ray . face) times its length
  std::array<double, 3> depth_m{};  ///< of a, ab and ac along the camera's axis
  std::array<Vector3, 3> normal{};  ///< of the corners, of any size; 0: flat
};

/// Prepares a triangle of a mesh, with the normals of its corners, both in the mesh's axes; flat triangles have normals
/// of 0.
[[nodiscard]] TriangleSight sight_of(const View& view, const std::array<double, 12>& transform,
                                     const std::array<Vector3, 3>& corner_m,
                                     const std::array<Vector3, 3>& normal) noexcept;

/// Distance along a ray to a triangle's plane, in units of the ray; infinite if they are parallel.
[[nodiscard]] double distance_along(const Vector3& ray, const TriangleSight& triangle) noexcept;

/// A triangle per lane.
struct TriangleLanes {
  VectorLanes<double> face;
  VectorLanes<double> b;
  VectorLanes<double> c;
  std::array<Lanes<double>, 3> depth_m;
  std::array<VectorLanes<double>, 3> normal;
};
/// Puts a triangle into one lane.
void put_lane(const TriangleSight& triangle, std::size_t lane, TriangleLanes& out) noexcept;

/// Hits of rays on triangles.
struct SightLanes {
  Lanes<float> depth_m;       ///< along the camera's axis
  VectorLanes<float> normal;  ///< unit, in world axes, on the camera's side
};

/// Depth and normal where rays from the camera hit triangles that they are known to hit, within rounding. Double
/// precision, in one order of operations, so that bits do not depend on the machine. A ray that misses its triangle by
/// rounding gets the nearest edge, one in its plane a corner. The normal is the triangle's or, if it is smooth,
/// interpolated between its corners, on the side that the camera sees, as in Cycles.
/// Source: T. Möller and B. Trumbore, Fast, minimum storage ray-triangle intersection, J. Graphics Tools 2(1), 1997.
void see_triangles(const VectorLanes<double>& direction, const TriangleLanes& triangle,
                   SightLanes& out) noexcept;

}  // namespace thermal
