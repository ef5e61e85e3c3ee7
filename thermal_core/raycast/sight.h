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

/// A vector of each lane.
template <typename Number>
using VectorLanes = std::array<Lanes<Number>, 3>;

/// Directions of rays through pixels, in world axes: one unit along the camera's axis.
[[nodiscard]] VectorLanes<double> directions(const View& view, const Lanes<double>& x,
                                             const Lanes<double>& y) noexcept;

/// Unit vectors of directions, and their lengths.
struct UnitLanes {
  VectorLanes<float> direction;
  Lanes<double> length;
};
/// Unit vectors along directions, and how long those are.
[[nodiscard]] UnitLanes units(const VectorLanes<double>& direction) noexcept;

/// What rays from the camera need to know of a triangle. It is a, a + ab, a + ac from the camera, in world axes.
struct TriangleSight {
  Vector3 face;       ///< ab x ac
  Vector3 b;          ///< ac x a: the share of ab at a ray's point is (ray . b) / (ray . face)
  Vector3 c;          ///< a x ab, likewise
  double volume = 0;  ///< a . face: a ray meets the triangle's plane at volume / (ray . face) times itself
  std::array<double, 3> depth_m{};  ///< of a, ab and ac along the camera's axis
  std::array<Vector3, 3> normal{};  ///< of the corners, of any size; 0: flat
};

/// Of a triangle of a mesh, with the normals of its corners, in the mesh's axes; flat triangles have normals of 0.
[[nodiscard]] TriangleSight sight_of(const View& view, const std::array<double, 12>& transform,
                                     const std::array<Vector3, 3>& corner_m,
                                     const std::array<Vector3, 3>& normal) noexcept;

/// How far along a ray the plane of a triangle is, in units of the ray; infinite if the ray is parallel to it.
[[nodiscard]] double distance_along(const Vector3& ray, const TriangleSight& triangle) noexcept;

/// A triangle of each lane.
struct TriangleLanes {
  VectorLanes<double> face;
  VectorLanes<double> b;
  VectorLanes<double> c;
  std::array<Lanes<double>, 3> depth_m;
  std::array<VectorLanes<double>, 3> normal;
};
/// Puts a triangle into one lane.
void put_lane(const TriangleSight& triangle, std::size_t lane, TriangleLanes& out) noexcept;

/// What rays see of triangles.
struct SightLanes {
  Lanes<float> depth_m;       ///< along the camera's axis
  VectorLanes<float> normal;  ///< unit, in world axes, on the camera's side
};

/// Where rays from the camera meet triangles that they are known to hit, within rounding: depth and normal there.
/// Double precision, in one order of operations, so that bits do not depend on the machine. A ray beside its triangle
/// gets the nearest edge, one in its plane a corner. The normal is the triangle's or, if it is smooth, one between
/// those of its corners; of both, Cycles has the side of the triangle that the camera sees.
/// Source: T. Möller and B. Trumbore, Fast, minimum storage ray-triangle intersection, J. Graphics Tools 2(1), 1997.
void see_triangles(const VectorLanes<double>& direction, const TriangleLanes& triangle,
                   SightLanes& out) noexcept;

}  // namespace thermal
