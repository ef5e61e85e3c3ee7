#pragma once

#include <array>
#include <cstddef>

#include "raycast/vectors.h"

namespace thermal {

/// Rays that are computed together.
inline constexpr std::size_t kLanes = 16;
template <typename Number>
using Lanes = std::array<Number, kLanes>;

/// A vector of each lane.
template <typename Number>
using VectorLanes = std::array<Lanes<Number>, 3>;

/// A transform of each lane, row-major 3 x 4: entry after entry, lane after lane.
using TransformLanes = std::array<double, 12 * kLanes>;

/// Directions of rays through pixels, in world axes: one unit along the camera's axis.
[[nodiscard]] VectorLanes<double> directions(const View& view, const Lanes<double>& x,
                                             const Lanes<double>& y) noexcept;

/// Unit vectors of directions, and their lengths.
struct UnitLanes {
  VectorLanes<float> direction;
  Lanes<double> length;
};
[[nodiscard]] UnitLanes units(const VectorLanes<double>& direction) noexcept;

/// The triangles that rays hit: of meshes, in their axes, with the transforms of these.
struct TriangleLanes {
  TransformLanes to_world;
  std::array<VectorLanes<double>, 3> corner_m;
  std::array<VectorLanes<double>, 3> normal;  ///< of the corners; flat triangles: 0
};

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
void see_triangles(const View& view, const VectorLanes<double>& direction, const TriangleLanes& triangle,
                   SightLanes& out) noexcept;

}  // namespace thermal
