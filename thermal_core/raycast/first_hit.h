#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raycast/embree.h"
#include "raycast/scene_accelerator.h"
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

/// First hits of the rays of a packet.
struct FirstHits {
  FirstHits() noexcept;

  Lanes<float> distance{};     ///< along the ray as Embree rounds it; infinite: nothing yet
  Lanes<unsigned> piece{};     ///< of the shot; kNoPiece: nothing
  Lanes<unsigned> triangle{};  ///< of its mesh
};

/// A search of a packet's rays, piece set by piece set. Embree computes distances with approximate reciprocals, which
/// differ between processors and instruction sets. Nearly equal distances are compared again in double precision, so
/// that results agree: AVX2 and AVX-512 in all of 240 frames of configs/savanna.json, where Embree alone has 2 other
/// objects and 28 other depths. Processors without fused multiply-add (before 2013) also round the edges of triangles
/// differently: 655 other objects. Costs 15 % of Embree's time.
class FirstHitSearch : public EmbreeContext {
 public:
  /// The rays' directions, of any length, and the shot's triangles must outlive this object.
  FirstHitSearch(const VectorLanes<double>& direction, SeenTriangles& triangles) noexcept;

  /// Searches pieces numbered from `first_piece`. Sets a ray's tfar to its first hit, or slightly beyond.
  void search(const PieceSet& set, unsigned first_piece, const PacketMask& mask, RayPacket& rays) noexcept;

  [[nodiscard]] const FirstHits& hits() const noexcept { return hits_; }

  /// Embree's filter function of all geometries: called for each triangle that a ray hits within its tfar.
  static void keep_first(const RTCFilterFunctionNArguments* arguments) noexcept;

 private:
  void keep_one(unsigned lane, unsigned piece, unsigned triangle, float& distance, int& valid) noexcept;
  [[nodiscard]] bool is_first(unsigned lane, unsigned piece, unsigned triangle) noexcept;

  const VectorLanes<double>& direction_;
  SeenTriangles& triangles_;
  unsigned first_piece_ = 0;
  FirstHits hits_;
};

}  // namespace thermal
