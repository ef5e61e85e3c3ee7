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
static_assert(kLanes == kPacketRays);
constexpr unsigned kNothing = RTC_INVALID_GEOMETRY_ID;

/// What each ray of a block hits first; null: nothing.
struct Hits {
  Lanes<const Piece*> piece{};
  Lanes<unsigned> triangle{};
};

/// The pixels of a packet: 4 x 4, fewer at the right and lower border.
struct Block {
  static constexpr int kWidthPx = 4;
  static constexpr int kHeightPx = static_cast<int>(kLanes) / kWidthPx;

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
  /// Actors first, which the actor layer shows; their hits then bound the search among the surroundings.
  void trace(const Block& block) const {
    alignas(RayPacket) PacketMask mask{};
    Lanes<double> x{};
    Lanes<double> y{};
    for (std::size_t k = 0; k < kLanes; ++k) {
      mask[k] = block.x(k) < rays_.width_px() && block.y(k) < rays_.height_px() ? -1 : 0;
      const auto column = static_cast<std::size_t>(std::min(block.x(k), rays_.width_px() - 1));
      const auto row = static_cast<std::size_t>(std::min(block.y(k), rays_.height_px() - 1));
      const LensPoint ray = rays_.at(column, row);
      x[k] = ray.x;
      y[k] = ray.y;
    }
    const VectorLanes<double> direction = directions(view_, x, y);
    RayPacket packet = aimed(direction);
    Hits hits;
    if (!actors_.pieces.empty()) find(actors_, mask, packet, hits);
    if (needs_.actors) put_objects(hits, mask, block, out_.actor_index);
    find(place_.surroundings(), mask, packet, hits);
    put_objects(hits, mask, block, out_.object_index);
    put_materials(hits, mask, block);
    if (needs_.depth || needs_.normals) put_sights(direction, hits, mask, block);
  }

  /// As in Cycles, a ray has unit length and starts at the nearest depth, in single precision: silhouettes then agree
  /// to 1e-4 px.
  [[nodiscard]] RayPacket aimed(const VectorLanes<double>& direction) const noexcept {
    const UnitLanes unit = units(direction);
    const auto x_m = static_cast<float>(view_.position_m.x);
    const auto y_m = static_cast<float>(view_.position_m.y);
    const auto z_m = static_cast<float>(view_.position_m.z);
    RayPacket packet;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto start_m = static_cast<float>(kNearestM * unit.length[k]);
      packet.ray.org_x[k] = x_m + start_m * unit.direction[0][k];
      packet.ray.org_y[k] = y_m + start_m * unit.direction[1][k];
      packet.ray.org_z[k] = z_m + start_m * unit.direction[2][k];
      packet.ray.dir_x[k] = unit.direction[0][k];
      packet.ray.dir_y[k] = unit.direction[1][k];
      packet.ray.dir_z[k] = unit.direction[2][k];
      packet.ray.tnear[k] = 0;
      packet.ray.tfar[k] = static_cast<float>((kFarthestM - kNearestM) * unit.length[k]);
      packet.ray.time[k] = 0;
      packet.ray.mask[k] = ~0U;
      packet.ray.id[k] = 0;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = kNothing;
      packet.hit.instID[0][k] = kNothing;
    }
    return packet;
  }

  static void find(const PieceSet& set, const PacketMask& mask, RayPacket& packet, Hits& hits) {
    find_nearest(set.scene.get(), mask, packet);
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (mask[k] == 0 || packet.hit.geomID[k] == kNothing) continue;
      hits.piece[k] = &set.pieces[packet.hit.instID[0][k]];
      hits.triangle[k] = packet.hit.primID[k];
      packet.hit.geomID[k] = kNothing;
    }
  }

  static void put_objects(const Hits& hits, const PacketMask& mask, const Block& block,
                          Plane<std::uint16_t>& plane) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (mask[k] == 0) continue;
      plane.at(block.x(k), block.y(k)) = hits.piece[k] == nullptr ? std::uint16_t{0} : hits.piece[k]->object;
    }
  }

  void put_materials(const Hits& hits, const PacketMask& mask, const Block& block) const {
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (mask[k] == 0) continue;
      out_.material_index.at(block.x(k), block.y(k)) =
          hits.piece[k] == nullptr ? std::uint16_t{0}
                                   : mesh_of(*hits.piece[k]).material_index[hits.triangle[k]];
    }
  }

  void put_sights(const VectorLanes<double>& direction, const Hits& hits, const PacketMask& mask,
                  const Block& block) const {
    TriangleLanes triangles;
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (hits.piece[k] != nullptr) gather(*hits.piece[k], hits.triangle[k], k, triangles);
    }
    SightLanes sights;
    see_triangles(view_, direction, triangles, sights);
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (mask[k] == 0) continue;
      const bool sky = hits.piece[k] == nullptr;
      if (needs_.depth) out_.depth_m.at(block.x(k), block.y(k)) = sky ? kSkyDepthM : sights.depth_m[k];
      for (std::size_t axis = 0; needs_.normals && axis < 3; ++axis)
        out_.normal[axis].at(block.x(k), block.y(k)) = sky ? 0.0F : sights.normal[axis][k];
    }
  }

  [[nodiscard]] const BakedMesh& mesh_of(const Piece& piece) const noexcept {
    return place_.scene().meshes[piece.mesh];
  }

  void gather(const Piece& piece, unsigned number, std::size_t k, TriangleLanes& lanes) const noexcept {
    const BakedMesh& mesh = mesh_of(piece);
    const auto& corners = mesh.triangles[number];
    const auto& normals = place_.normals(piece.mesh);
    for (std::size_t entry = 0; entry < 12; ++entry)
      lanes.to_world[entry * kLanes + k] = piece.to_world[entry];
    for (std::size_t which = 0; which < 3; ++which) {
      const auto& point_m = mesh.points_m[corners[which]];
      for (std::size_t axis = 0; axis < 3; ++axis)
        lanes.corner_m[which][axis][k] = static_cast<double>(point_m[axis]);
      if (normals.empty()) continue;
      const auto& normal = normals[corners[which]];
      for (std::size_t axis = 0; axis < 3; ++axis)
        lanes.normal[which][axis][k] = static_cast<double>(normal[axis]);
    }
  }

  const Place& place_;
  const PieceSet& actors_;
  const View& view_;
  const PixelRays& rays_;
  const PassNeeds& needs_;
  Passes& out_;
};

}  // namespace

PixelRays::PixelRays(const CameraIntrinsics& camera, const LensDistortion& lens)
    : width_px_(camera.width_px), height_px_(camera.height_px) {
  for (int x = 0; x < width_px_; ++x) x_.push_back((x + 0.5 - camera.cx_px) / camera.fx_px);
  for (int y = 0; y < height_px_; ++y) y_.push_back((y + 0.5 - camera.cy_px) / camera.fy_px);
  if (lens.is_none()) return;
  bent_.resize(x_.size() * y_.size());
  parallel_for(y_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * x_.size(); k < end * x_.size(); ++k)
      bent_[k] = undistort(lens, {.x = x_[k % x_.size()], .y = y_[k / x_.size()]});
  });
}

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
