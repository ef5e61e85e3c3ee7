#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raycast/shot.h"
#include "raycast/sight.h"

namespace thermal {

/// A triangle of a piece, relative to the camera of a shot.
struct SeenTriangle {
  unsigned piece = kNoPiece;
  unsigned number = 0;
  std::uint16_t object = 0;
  std::uint16_t material = 0;
  double height_m = 0;  ///< of its first corner, in the world
  TriangleSight sight;
};

/// Cache of a shot's triangles, because neighbouring rays often hit the same ones. For one thread.
class SeenTriangles {
 public:
  explicit SeenTriangles(const Shot& shot) : shot_(shot) {}

  /// A triangle of a piece of the shot; valid until the next call.
  const SeenTriangle& at(unsigned piece, unsigned number) noexcept {
    SeenTriangle& accelerator = kept_[(31 * piece + number) % kept_.size()];
    if (accelerator.piece != piece || accelerator.number != number) accelerator = seen(piece, number);
    return accelerator;
  }

 private:
  [[nodiscard]] SeenTriangle seen(unsigned piece, unsigned number) const noexcept;

  const Shot& shot_;
  std::array<SeenTriangle, 64> kept_;
};

}  // namespace thermal
