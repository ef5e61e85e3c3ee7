#include "raycast/frame_tracer.h"

#include <algorithm>

#include "base/parallel.h"
#include "raycast/sight.h"

namespace thermal {
namespace {

// Depths at which a camera sees surfaces: those of the camera in blender_scripts/veldt_bl/camera.py.
constexpr double kNearestM = 0.1;
constexpr double kFarthestM = 20000;

constexpr float kSkyDepthM = 1e10F;  // as Blender has it
constexpr unsigned kNothing = RTC_INVALID_GEOMETRY_ID;

/// What a ray hits first.
struct Hit {
  const Piece* piece = nullptr;  ///< null: nothing
  unsigned triangle = 0;
};

/// The pixels of a packet: 4 x 2, fewer at the right and lower border.
struct Block {
  static constexpr int kWidthPx = 4;
  static constexpr int kHeightPx = static_cast<int>(kPacketRays) / kWidthPx;

  [[nodiscard]] int x(std::size_t ray) const noexcept { return x_px + static_cast<int>(ray) % kWidthPx; }
  [[nodiscard]] int y(std::size_t ray) const noexcept { return y_px + static_cast<int>(ray) / kWidthPx; }

  int x_px = 0;
  int y_px = 0;
};

template <typename T>
void fit(Plane<T>& plane, bool wanted, const PixelRays& rays) {
  const int width_px = wanted ? rays.width_px() : 0;
  const int height_px = wanted ? rays.height_px() : 0;
  if (plane.width_px() != width_px || plane.height_px() != height_px) plane = Plane<T>(width_px, height_px);
}

void fit(Passes& passes, const PassNeeds& needs, const PixelRays& rays) {
  fit(passes.object_index, true, rays);
  fit(passes.material_index, true, rays);
  fit(passes.actor_index, needs.actors, rays);
  fit(passes.depth_m, needs.depth, rays);
  for (Plane<float>& axis : passes.normal) fit(axis, needs.normals, rays);
  passes.ranks.clear();
}

class FrameTracer {
 public:
  FrameTracer(const Place& place, const PieceSet& actors, const View& view, const PixelRays& rays,
              const PassNeeds& needs, Passes& out)
      : place_(place), actors_(actors), view_(view), rays_(rays), needs_(needs), out_(out) {}

  void trace_rows(int y_px) const {
    for (int x_px = 0; x_px < rays_.width_px(); x_px += Block::kWidthPx) trace({.x_px = x_px, .y_px = y_px});
  }

 private:
  using Hits = std::array<Hit, kPacketRays>;
  using Mask = PacketMask;

  /// Actors first, which the actor layer shows; their hits then bound the search among the surroundings.
  void trace(const Block& block) const {
    alignas(RayPacket) Mask mask{};
    RayPacket packet;
    for (std::size_t k = 0; k < kPacketRays; ++k) {
      mask[k] = block.x(k) < rays_.width_px() && block.y(k) < rays_.height_px() ? -1 : 0;
      if (mask[k] != 0) aim(direction(block.x(k), block.y(k)), packet, k);
    }
    Hits hits{};
    if (!actors_.pieces.empty()) find(actors_, mask, packet, hits);
    if (needs_.actors) {
      for (std::size_t k = 0; k < kPacketRays; ++k)
        if (mask[k] != 0) out_.actor_index.at(block.x(k), block.y(k)) = object_of(hits[k]);
    }
    find(place_.surroundings(), mask, packet, hits);
    for (std::size_t k = 0; k < kPacketRays; ++k)
      if (mask[k] != 0) put(hits[k], block.x(k), block.y(k));
  }

  static std::uint16_t object_of(const Hit& hit) noexcept {
    return hit.piece == nullptr ? 0 : hit.piece->object;
  }

  [[nodiscard]] Vector3 direction(int x_px, int y_px) const noexcept {
    const LensPoint ray = rays_.at(x_px, y_px);
    return ray.x * view_.right + ray.y * view_.down + view_.forward;
  }

  /// As in Cycles, a ray has unit length and starts at the nearest depth, in single precision: silhouettes then agree
  /// to 1e-4 px.
  void aim(const Vector3& direction, RayPacket& packet, std::size_t k) const noexcept {
    const double size = length(direction);
    const auto start_m = static_cast<float>(kNearestM * size);
    const auto end_m = static_cast<float>((kFarthestM - kNearestM) * size);
    const std::array unit = {static_cast<float>(direction.x / size), static_cast<float>(direction.y / size),
                             static_cast<float>(direction.z / size)};
    packet.ray.org_x[k] = static_cast<float>(view_.position_m.x) + start_m * unit[0];
    packet.ray.org_y[k] = static_cast<float>(view_.position_m.y) + start_m * unit[1];
    packet.ray.org_z[k] = static_cast<float>(view_.position_m.z) + start_m * unit[2];
    packet.ray.dir_x[k] = unit[0];
    packet.ray.dir_y[k] = unit[1];
    packet.ray.dir_z[k] = unit[2];
    packet.ray.tnear[k] = 0;
    packet.ray.tfar[k] = end_m;
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = ~0U;
    packet.ray.id[k] = 0;
    packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = kNothing;
    packet.hit.instID[0][k] = kNothing;
  }

  static void find(const PieceSet& set, const Mask& mask, RayPacket& packet, Hits& hits) {
    find_nearest(set.scene.get(), mask, packet);
    for (std::size_t k = 0; k < kPacketRays; ++k) {
      if (mask[k] == 0 || packet.hit.geomID[k] == kNothing) continue;
      hits[k] = {.piece = &set.pieces[packet.hit.instID[0][k]], .triangle = packet.hit.primID[k]};
      packet.hit.geomID[k] = kNothing;
    }
  }

  void put(const Hit& hit, int x_px, int y_px) const {
    out_.object_index.at(x_px, y_px) = object_of(hit);
    out_.material_index.at(x_px, y_px) =
        hit.piece == nullptr ? std::uint16_t{0}
                             : place_.scene().meshes[hit.piece->mesh].material_index[hit.triangle];
    if (!needs_.depth && !needs_.normals) return;
    const Sight sight = hit.piece == nullptr ? Sight() : see(hit, direction(x_px, y_px));
    if (needs_.depth) {
      out_.depth_m.at(x_px, y_px) =
          hit.piece == nullptr ? kSkyDepthM : static_cast<float>(dot(view_.forward, sight.point_m));
    }
    if (!needs_.normals) return;
    out_.normal[0].at(x_px, y_px) = static_cast<float>(sight.normal.x);
    out_.normal[1].at(x_px, y_px) = static_cast<float>(sight.normal.y);
    out_.normal[2].at(x_px, y_px) = static_cast<float>(sight.normal.z);
  }

  [[nodiscard]] Sight see(const Hit& hit, const Vector3& ray) const {
    const BakedMesh& mesh = place_.scene().meshes[hit.piece->mesh];
    const auto& normals = place_.normals(hit.piece->mesh);
    PlacedTriangle triangle;
    triangle.smooth = !normals.empty();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = mesh.triangles[hit.triangle].at(k);
      triangle.corner_m.at(k) = transformed(hit.piece->to_world, mesh.points_m[corner]) - view_.position_m;
      if (triangle.smooth) triangle.normal.at(k) = vector_of(normals[corner]);
    }
    return see_triangle(ray, triangle, hit.piece->to_world);
  }

  const Place& place_;
  const PieceSet& actors_;
  const View& view_;
  const PixelRays& rays_;
  const PassNeeds& needs_;
  Passes& out_;
};

}  // namespace

View view_of(const std::array<double, 16>& camera_to_world) noexcept {
  std::array<float, 16> m{};
  std::ranges::transform(camera_to_world, m.begin(), [](double entry) { return static_cast<float>(entry); });
  return {.right = vector_of<float>({m[0], m[4], m[8]}),
          .down = vector_of<float>({m[1], m[5], m[9]}),
          .forward = vector_of<float>({m[2], m[6], m[10]}),
          .position_m = vector_of<float>({m[3], m[7], m[11]})};
}

void trace_frame(const Place& place, const PieceSet& actors, const View& view, const PixelRays& rays,
                 const PassNeeds& needs, Passes& out) {
  constexpr std::size_t kBlockRowsAChunk = 4;
  fit(out, needs, rays);
  const FrameTracer tracer(place, actors, view, rays, needs, out);
  const auto block_rows =
      static_cast<std::size_t>((rays.height_px() + Block::kHeightPx - 1) / Block::kHeightPx);
  parallel_for(block_rows, kBlockRowsAChunk, [&tracer](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) tracer.trace_rows(static_cast<int>(k) * Block::kHeightPx);
  });
}

}  // namespace thermal
