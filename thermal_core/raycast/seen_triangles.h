#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raycast/shot.h"
#include "raycast/sight.h"

namespace thermal {

/// A triangle of a piece, as the camera of a shot sees it.
struct SeenTriangle {
  unsigned piece = kNoPiece;
  unsigned number = 0;
  std::uint16_t object = 0;
  std::uint16_t material = 0;
  double height_m = 0;  ///< of its first corner, in the world
  TriangleSight sight;
};

/// The triangles of a shot. The last ones are kept, because rays beside each other often hit the same ones. For one
/// thread.
class SeenTriangles {
 public:
  explicit SeenTriangles(const Shot& shot) : shot_(shot) {}

  /// Of a piece of the shot; until the next call.
  const SeenTriangle& at(unsigned piece, unsigned number) noexcept {
    SeenTriangle& place = kept_[(31 * piece + number) % kept_.size()];
    if (place.piece != piece || place.number != number) place = seen(piece, number);
    return place;
  }

 private:
  [[nodiscard]] SeenTriangle seen(unsigned piece, unsigned number) const noexcept;

  const Shot& shot_;
  std::array<SeenTriangle, 64> kept_;
};

}  // namespace thermal
