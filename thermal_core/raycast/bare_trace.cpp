#include "raycast/bare_trace.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/parallel.h"
#include "raycast/pixel_rays.h"
#include "raycast/place.h"
#include "raycast/ray_packets.h"

namespace thermal {
namespace {

/// Rays of a packet before they are traced.
struct AimedPacket {
  RTCRay16 ray{};
  alignas(RayPacket) PacketMask mask{};
};

/// How many of its rays hit something.
std::size_t hits_of(const AimedPacket& before, RTCScene scene) {
  RayPacket packet;
  packet.ray = before.ray;
  std::fill_n(packet.hit.geomID, kLanes, kNothing);
  std::fill_n(packet.hit.instID[0], kLanes, kNothing);
  EmbreeContext context = coherent_rays();
  find_nearest(scene, before.mask, context, packet);
  std::size_t hits = 0;
  for (std::size_t k = 0; k < kLanes; ++k)
    hits += before.mask[k] != 0 && packet.hit.geomID[k] != kNothing ? 1U : 0U;
  return hits;
}

}  // namespace

struct BareTracer::Aimed {
  std::vector<AimedPacket> packets;
  std::size_t packets_a_chunk = 1;
};

BareTracer::BareTracer(const BakedScene& scene)
    : place_(std::make_unique<const Place>(scene, nullptr)), aimed_(std::make_unique<Aimed>()) {}
BareTracer::~BareTracer() = default;

void BareTracer::aim(const std::array<double, 16>& camera_to_world, const CameraIntrinsics& camera) {
  constexpr std::size_t kRows = 2;  // of blocks, which a thread takes at once, as in trace_pixels()
  const PixelRays rays(camera, {});
  const View view = view_of(camera_to_world);
  const Plane<std::uint8_t> no_actors(rays.width_px(), rays.height_px());
  aimed_->packets.clear();
  aimed_->packets_a_chunk = kRows * static_cast<std::size_t>((camera.width_px + kBlockPx - 1) / kBlockPx);
  for (int y_px = 0; y_px < rays.height_px(); y_px += kBlockPx) {
    for (int x_px = 0; x_px < rays.width_px(); x_px += kBlockPx) {
      const Packet packet = block_at(x_px, y_px, rays, no_actors);
      aimed_->packets.push_back(
          {aimed(view, directions(view, packet.x, packet.y), place_->scene().depth_range_m).ray,
           packet.mask});
    }
  }
}

std::size_t BareTracer::hits() const {
  RTCScene scene = place_->surroundings().scene.get();
  std::atomic<std::size_t> hits = 0;
  parallel_for(aimed_->packets.size(), aimed_->packets_a_chunk, [&](std::size_t begin, std::size_t end) {
    std::size_t some = 0;
    for (std::size_t k = begin; k < end; ++k) some += hits_of(aimed_->packets[k], scene);
    hits += some;
  });
  return hits;
}

}  // namespace thermal
