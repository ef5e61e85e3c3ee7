#include "raycast/first_hit.h"

#include <limits>
#include <utility>

#include "base/clones.h"

namespace thermal {

SeenTriangle SeenTriangles::seen(unsigned number_of_piece, unsigned number) const noexcept {
  const Piece& piece = shot_.piece(number_of_piece);
  const BakedMesh& mesh = shot_.accelerator.scene().meshes[piece.mesh];
  const auto& normals = shot_.accelerator.normals(piece.mesh);
  std::array<Vector3, 3> corner_m;
  std::array<Vector3, 3> normal;
  for (std::size_t which = 0; which < 3; ++which) {
    const std::size_t corner = mesh.triangles[number][which];
    corner_m[which] = vector_of(mesh.points_m[corner]);
    if (!normals.empty()) normal[which] = vector_of(normals[corner]);
  }
  const auto& to_world = piece.to_world;
  const Vector3& first = corner_m[0];
  return {.piece = number_of_piece,
          .number = number,
          .object = piece.object,
          .material = mesh.material_index[number],
          .height_m = to_world[8] * first.x + to_world[9] * first.y + to_world[10] * first.z + to_world[11],
          .sight = sight_of(shot_.view, piece.to_world, corner_m, normal)};
}

namespace {

/// Tolerance for ties: distances this close may be in another order on other processors, whose reciprocals differ by up
/// to 2.4e-7.
constexpr float kTie = 1e-6F;

/// Hits of one call of the filter function, by ray.
struct Found {
  unsigned rays;
  int* valid;
  float* distance;
  const unsigned* lane;
  const unsigned* instance;
  const unsigned* triangle;
};

Found found_in(const RTCFilterFunctionNArguments& found) noexcept {
  return {.rays = found.N,
          .valid = found.valid,
          .distance = &RTCRayN_tfar(found.ray, found.N, 0),
          .lane = &RTCRayN_id(found.ray, found.N, 0),
          .instance = &RTCHitN_instID(found.hit, found.N, 0, 0),
          .triangle = &RTCHitN_primID(found.hit, found.N, 0)};
}

/// Keeps the hits of all lanes if none of them is in a tie; otherwise does nothing and returns false.
VELDT_CLONES
bool keep_clear(const Found& found, unsigned first_piece, FirstHits& hits) noexcept {
  const Found in = found;
  float* const distance = hits.distance.data();
  unsigned* const piece = hits.piece.data();
  unsigned* const triangle = hits.triangle.data();
  unsigned others = 0;
  for (unsigned k = 0; k < kLanes; ++k) {
    const bool tied = in.valid[k] != 0 && in.distance[k] > distance[k] * (1 - kTie);
    others |= (in.lane[k] ^ k) | (tied ? 1U : 0U);
  }
  if (others != 0) return false;
  for (unsigned k = 0; k < kLanes; ++k) {
    const bool kept = in.valid[k] != 0;
    distance[k] = kept ? in.distance[k] : distance[k];
    piece[k] = kept ? first_piece + in.instance[k] : piece[k];
    triangle[k] = kept ? in.triangle[k] : triangle[k];
    in.distance[k] = kept ? in.distance[k] * (1 + kTie) : in.distance[k];
  }
  return true;
}

}  // namespace

FirstHits::FirstHits() noexcept {
  distance.fill(std::numeric_limits<float>::infinity());
  piece.fill(kNoPiece);
  triangle.fill(0);
}

FirstHitSearch::FirstHitSearch(const VectorLanes<double>& direction, SeenTriangles& triangles) noexcept
    : EmbreeContext(coherent_rays()), direction_(direction), triangles_(triangles) {}

void FirstHitSearch::search(const PieceSet& set, unsigned first_piece, const PacketMask& mask,
                            RayPacket& rays) noexcept {
  first_piece_ = first_piece;
  find_nearest(set.scene.get(), mask, *this, rays);
}

void FirstHitSearch::keep_first(const RTCFilterFunctionNArguments* arguments) noexcept {
  auto& search = static_cast<FirstHitSearch&>(*arguments->context);
  const Found found = found_in(*arguments);
  if (found.rays == kLanes && keep_clear(found, search.first_piece_, search.hits_)) return;
  for (unsigned k = 0; k < found.rays; ++k) {
    if (found.valid[k] == 0) continue;
    search.keep_one(found.lane[k], search.first_piece_ + found.instance[k], found.triangle[k],
                    found.distance[k], found.valid[k]);
  }
}

/// `distance` becomes the ray's tfar, slightly increased, so that Embree also reports hits at the same distance.
/// `valid` 0: not kept.
void FirstHitSearch::keep_one(unsigned lane, unsigned piece, unsigned triangle, float& distance,
                              int& valid) noexcept {
  if (distance > hits_.distance[lane] * (1 - kTie) && !is_first(lane, piece, triangle)) {
    valid = 0;
    return;
  }
  hits_.distance[lane] = distance;
  hits_.piece[lane] = piece;
  hits_.triangle[lane] = triangle;
  distance *= 1 + kTie;
}

/// Whether a triangle precedes the ray's first one so far; coincident triangles are ordered by their numbers.
bool FirstHitSearch::is_first(unsigned lane, unsigned piece, unsigned triangle) noexcept {
  const Vector3 ray{direction_[0][lane], direction_[1][lane], direction_[2][lane]};
  const double here = distance_along(ray, triangles_.at(piece, triangle).sight);
  const double there = distance_along(ray, triangles_.at(hits_.piece[lane], hits_.triangle[lane]).sight);
  if (here != there) return here < there;
  return std::pair(piece, triangle) < std::pair(hits_.piece[lane], hits_.triangle[lane]);
}

}  // namespace thermal
