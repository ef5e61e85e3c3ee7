#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raycast/embree.h"
#include "raycast/vectors.h"
#include "scene/baked_scene.h"

namespace thermal {

/// A mesh in its position: a surface, a plant, or a bone of an actor.
struct Piece {
  std::uint32_t mesh = 0;
  std::uint16_t object = 0;
  Transform<double> to_world{};
};

/// Pieces and their acceleration structure. A hit's instID is an index into `pieces`.
struct PieceSet {
  std::vector<Piece> pieces;
  EmbreeScene scene;
};

/// Bounding box of a mesh's points [m].
using MeshBox = std::array<std::array<double, 3>, 2>;

/// A baked scene with the acceleration structures that all its frames share.
class SceneAccelerator {
 public:
  /// The scene must outlive this object. Embree calls `filter` for each hit; null: it keeps the first hit. Error if
  /// there is not enough memory.
  SceneAccelerator(const BakedScene& scene, RTCFilterFunctionN filter);

  [[nodiscard]] const BakedScene& scene() const noexcept { return scene_; }

  /// Ground, waters and plants.
  [[nodiscard]] const PieceSet& surroundings() const noexcept { return surroundings_; }

  /// Normals of a mesh's points; empty if the mesh is not smooth.
  [[nodiscard]] const std::vector<std::array<float, 3>>& normals(std::size_t mesh) const noexcept {
    return normals_[mesh];
  }

  [[nodiscard]] bool has_water() const noexcept { return mirrors_.any(); }

  /// Pieces of the surroundings that have triangles that mirror.
  [[nodiscard]] const std::vector<Piece>& waters() const noexcept { return waters_; }

  /// Whether triangles of this object and material mirror.
  [[nodiscard]] bool is_water(std::uint16_t object, std::uint16_t material) const noexcept {
    return mirrors_.has(object, material);
  }

  [[nodiscard]] const MeshBox& box(std::size_t mesh) const noexcept { return boxes_[mesh]; }

  /// Builds the acceleration structure of pieces, leaving out those with a degenerate transform: flattened to less than
  /// 1e-6 of its size, smaller than 1e-8 or 1e9 m away. Safe to call from several threads.
  [[nodiscard]] PieceSet set_of(std::vector<Piece> pieces) const;

 private:
  const BakedScene& scene_;
  EmbreeDevice device_;
  std::vector<EmbreeScene> meshes_;  ///< each alone
  std::vector<std::vector<std::array<float, 3>>> normals_;
  std::vector<MeshBox> boxes_;
  PieceSet surroundings_;
  MirrorIndices mirrors_;
  std::vector<Piece> waters_;
};

inline constexpr unsigned kNoPiece = ~0U;  ///< number of a piece that does not exist: the ray hits nothing

/// A frame to be traced: scene, actors in their poses, camera.
struct Shot {
  const SceneAccelerator& accelerator;
  const PieceSet& actors;
  View view;

  /// Pieces have one numbering: the actors, then the surroundings.
  [[nodiscard]] unsigned first_surrounding() const noexcept {
    return static_cast<unsigned>(actors.pieces.size());
  }
  [[nodiscard]] const Piece& piece(unsigned number) const noexcept {
    return number < first_surrounding() ? actors.pieces[number]
                                        : accelerator.surroundings().pieces[number - first_surrounding()];
  }
};

}  // namespace thermal
