#pragma once

#include "raycast/embree.h"
#include "raycast/seen_triangles.h"
#include "raycast/sight.h"

namespace thermal {

/// What each ray of a packet hits first.
struct FirstHits {
  FirstHits() noexcept;

  Lanes<float> distance{};     ///< along the ray as Embree rounds it; infinite: nothing yet
  Lanes<unsigned> piece{};     ///< of the shot; kNoPiece: nothing
  Lanes<unsigned> triangle{};  ///< of its mesh
};

/// A search of a packet's rays, piece set by piece set. Embree computes distances with approximate reciprocals, which
/// differ between processors and instruction sets. Where two distances are that close, the triangle is first that is so
/// in double precision, so that all of them show the same: AVX2 and AVX-512 in all of 240 frames of configs/savanna.json,
/// where Embree alone has 2 other objects and 28 other depths. Processors without fused multiply-add (before 2013)
/// also round the edges of triangles differently: 655 other objects. Costs 15 % of Embree's time.
class FirstHitSearch : public EmbreeContext {
 public:
  /// The rays' directions, of any length, and the shot's triangles must outlive this object.
  FirstHitSearch(const VectorLanes<double>& direction, SeenTriangles& triangles) noexcept;

  /// Searches pieces that are numbered from `first_piece`. A ray's tfar is brought to its first hit, or little beyond.
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
