#pragma once

#include "raycast/embree.h"
#include "raycast/seen_triangles.h"
#include "raycast/sight.h"

namespace thermal {

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
