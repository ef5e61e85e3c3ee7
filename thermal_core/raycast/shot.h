#pragma once

#include "raycast/scene_accelerator.h"
#include "raycast/vectors.h"

namespace thermal {

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
