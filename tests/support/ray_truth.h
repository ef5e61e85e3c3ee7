#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/camera_model.h"
#include "support/small_scene.h"

/// What rays see, by trying every triangle, in long double and by other formulas than the library's.
namespace ray_truth {

using Number = long double;

struct Vector {
  Number x = 0;
  Number y = 0;
  Number z = 0;
};

inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Number f, const Vector& a) { return {f * a.x, f * a.y, f * a.z}; }
inline Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Number length(const Vector& a) { return std::sqrt(dot(a, a)); }
inline Vector unit(const Vector& a) { return length(a) > 0 ? (1 / length(a)) * a : Vector(); }
inline Vector vector_of(const shapes::Point& p) { return {p[0], p[1], p[2]}; }

/// Blender's normals of points: those of the triangles around, weighted by their angles. Degenerate triangles count
/// for nothing; a point without others has the direction from the origin.
inline std::vector<Vector> point_normals(const shapes::Shape& shape) {
  std::vector<Vector> sums(shape.points_m.size());
  for (const shapes::Corners& corners : shape.triangles) {
    std::array<Vector, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p.at(k) = vector_of(shape.points_m[corners.at(k)]);
    const Vector normal = unit(cross(p[1] - p[0], p[2] - p[0]));
    if (length(normal) == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector next = unit(p.at((k + 1) % 3) - p.at(k));
      const Vector last = unit(p.at((k + 2) % 3) - p.at(k));
      Vector& sum = sums[corners.at(k)];
      sum = sum + std::acos(std::clamp(dot(next, last), Number{-1}, Number{1})) * normal;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k)
    sums[k] = length(sums[k]) > 0 ? unit(sums[k]) : unit(vector_of(shape.points_m[k]));
  return sums;
}

/// A triangle in its position.
struct Triangle {
  std::array<Vector, 3>
      edge;           ///< normals of the planes through the camera and the sides opposite to each corner
  Vector plane;       ///< its own
  Number offset = 0;  ///< of that plane from the camera, in units of its normal
  Vector face;        ///< outwards
  std::array<Vector, 3> normal;  ///< of its corners, which is that of the face if it is not smooth
  std::uint16_t object = 0;
  std::uint16_t material = 0;
  bool actor = false;
};

/// The inverse transpose of a transform's first three columns.
class NormalTransform {
 public:
  explicit NormalTransform(const small_scene::Matrix& m) {
    const std::array<Vector, 3> row = {Vector{m[0], m[1], m[2]}, Vector{m[4], m[5], m[6]},
                                       Vector{m[8], m[9], m[10]}};
    const Number determinant = dot(row[0], cross(row[1], row[2]));
    for (std::size_t k = 0; k < 3; ++k)
      row_.at(k) = (1 / determinant) * cross(row.at((k + 1) % 3), row.at((k + 2) % 3));
  }
  [[nodiscard]] Vector operator()(const Vector& n) const {
    return {dot(row_[0], n), dot(row_[1], n), dot(row_[2], n)};
  }

 private:
  std::array<Vector, 3> row_;
};

inline Vector moved(const small_scene::Matrix& m, const Vector& p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

struct Piece {
  const shapes::Shape* shape = nullptr;
  small_scene::Matrix to_world{};
  std::uint16_t object = 0;
  bool actor = false;
};

inline void append(std::vector<Triangle>& triangles, const Piece& piece, const Vector& camera_m) {
  const std::vector<Vector> normals = point_normals(*piece.shape);
  const NormalTransform turned(piece.to_world);
  for (std::size_t k = 0; k < piece.shape->triangles.size(); ++k) {
    Triangle triangle;
    triangle.object = piece.object;
    triangle.material = piece.shape->materials[k];
    triangle.actor = piece.actor;
    std::array<Vector, 3> point;
    std::array<Vector, 3> seen;
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t corner = piece.shape->triangles[k].at(n);
      point.at(n) = vector_of(piece.shape->points_m[corner]);
      seen.at(n) = moved(piece.to_world, point.at(n)) - camera_m;
      triangle.normal.at(n) = turned(normals[corner]);
    }
    for (std::size_t n = 0; n < 3; ++n)
      triangle.edge.at(n) = cross(seen.at((n + 1) % 3), seen.at((n + 2) % 3));
    triangle.plane = cross(seen[1] - seen[0], seen[2] - seen[0]);
    triangle.offset = dot(triangle.plane, seen[0]);
    triangle.face = turned(cross(point[1] - point[0], point[2] - point[0]));
    if (!piece.shape->smooth) triangle.normal = {triangle.face, triangle.face, triangle.face};
    triangles.push_back(triangle);
  }
}

/// A transform in the precision of a track.
inline small_scene::Matrix single(const small_scene::Matrix& m) {
  small_scene::Matrix rounded{};
  std::transform(m.begin(), m.end(), rounded.begin(), [](double entry) { return static_cast<float>(entry); });
  return rounded;
}

/// All triangles of a frame.
inline std::vector<Triangle> triangles_in(const small_scene::Scenery& place, const small_scene::Clip& clip,
                                          std::size_t frame) {
  const auto& pose = clip.camera_to_world[frame];
  std::vector<Piece> pieces;
  for (const thermal::BakedSurface& surface : place.surfaces)
    pieces.push_back({&place.meshes[surface.mesh], small_scene::kIdentity, surface.object, false});
  for (const auto& plants : place.plants) {
    for (std::size_t k = 0; k < plants.mesh.size(); ++k)
      pieces.push_back({&place.meshes[plants.mesh[k]], plants.transform[k], plants.object, false});
  }
  for (std::size_t actor = 0; actor < clip.poses.size(); ++actor) {
    const auto& bones = clip.poses[actor][frame];
    for (std::size_t bone = 0; bone < bones.size(); ++bone) {
      const thermal::BakedActor& body = place.actors[actor];
      pieces.push_back({&place.meshes[body.bones[bone].mesh], single(bones[bone]), body.object, true});
    }
  }
  std::vector<Triangle> triangles;
  for (const Piece& piece : pieces) append(triangles, piece, {pose[3], pose[7], pose[11]});
  return triangles;
}

struct Axes {
  Vector right;
  Vector down;
  Vector forward;

  explicit Axes(const std::array<double, 16>& pose)
      : right{pose[0], pose[4], pose[8]},
        down{pose[1], pose[5], pose[9]},
        forward{pose[2], pose[6], pose[10]} {}
};

/// A ray in camera axes, z being 1.
struct Ray {
  Number x = 0;
  Number y = 0;
};

/// Through the centre of a pixel. The lens's formula is inverted by repeated substitution, which converges where the
/// lens bends little.
inline Ray ray_of(const thermal::CameraIntrinsics& camera, const thermal::LensDistortion& lens, int x_px,
                  int y_px) {
  const Ray shown = {(x_px + Number{0.5} - camera.cx_px) / camera.fx_px,
                     (y_px + Number{0.5} - camera.cy_px) / camera.fy_px};
  Ray seen = shown;
  for (int k = 0; k < 200; ++k) {
    const Number r2 = seen.x * seen.x + seen.y * seen.y;
    const Number radial = 1 + r2 * lens.k1 + r2 * r2 * lens.k2 + r2 * r2 * r2 * lens.k3;
    seen = {(shown.x - 2 * lens.p1 * seen.x * seen.y - lens.p2 * (r2 + 2 * seen.x * seen.x)) / radial,
            (shown.y - lens.p1 * (r2 + 2 * seen.y * seen.y) - 2 * lens.p2 * seen.x * seen.y) / radial};
  }
  return seen;
}

inline Vector direction(const Axes& axes, const Ray& ray) {
  return ray.x * axes.right + ray.y * axes.down + axes.forward;
}

/// Where a ray meets a triangle.
struct Meeting {
  Number depth = 0;
  Vector normal;  ///< unit, towards the camera
};

inline std::optional<Meeting> meet(const Triangle& triangle, const Axes& axes, const Ray& ray) {
  constexpr Number kNearest = 0.1L;
  constexpr Number kFarthest = 20000;
  const Vector d = direction(axes, ray);
  const Number a = dot(d, triangle.edge[0]);
  const Number b = dot(d, triangle.edge[1]);
  const Number c = dot(d, triangle.edge[2]);
  const bool inside = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
  const Number slope = dot(triangle.plane, d);
  if (!inside || slope == 0) return std::nullopt;
  const Number times = triangle.offset / slope;
  if (times < kNearest || times > kFarthest) return std::nullopt;
  const Vector normal = unit(a * triangle.normal[0] + b * triangle.normal[1] + c * triangle.normal[2]);
  // The shares of the corners, which are positive, are a, b and c / their sum.
  const Number sign = (a + b + c > 0 ? 1 : -1) * (dot(triangle.face, d) > 0 ? -1 : 1);
  return Meeting{.depth = times * dot(axes.forward, d), .normal = sign * normal};
}

}  // namespace ray_truth
