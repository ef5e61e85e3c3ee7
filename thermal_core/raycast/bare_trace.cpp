#include "raycast/bare_trace.h"

#include <algorithm>
#include <atomic>
#include <chrono>
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

std::vector<AimedPacket> packets_of(const View& view, const PixelRays& rays) {
  const Plane<std::uint8_t> no_actors(rays.width_px(), rays.height_px());
  std::vector<AimedPacket> packets;
  for (int y_px = 0; y_px < rays.height_px(); y_px += kBlockPx) {
    for (int x_px = 0; x_px < rays.width_px(); x_px += kBlockPx) {
      const Packet packet = block_at(x_px, y_px, rays, no_actors);
      packets.push_back({aimed(view, directions(view, packet.x, packet.y)).ray, packet.mask});
    }
  }
  return packets;
}

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

std::size_t hits_of(const std::vector<AimedPacket>& packets, std::size_t grain, RTCScene scene) {
  std::atomic<std::size_t> hits = 0;
  parallel_for(packets.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::size_t some = 0;
    for (std::size_t k = begin; k < end; ++k) some += hits_of(packets[k], scene);
    hits += some;
  });
  return hits;
}

}  // namespace

BareTracer::BareTracer(const BakedScene& scene) : place_(std::make_unique<const Place>(scene, nullptr)) {}
BareTracer::~BareTracer() = default;

BareTrace BareTracer::trace(const std::array<double, 16>& camera_to_world,
                            const CameraIntrinsics& camera) const {
  constexpr std::size_t kRows = 2;  // of blocks, which a thread takes at once, as in trace_pixels()
  const PixelRays rays(camera, {});
  const std::vector<AimedPacket> packets = packets_of(view_of(camera_to_world), rays);
  const auto blocks = static_cast<std::size_t>((camera.width_px + kBlockPx - 1) / kBlockPx);
  RTCScene scene = place_->surroundings().scene.get();
  BareTrace trace = {
      .rays = static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px),
      .hits = hits_of(packets, kRows * blocks, scene)};
  std::array<double, 3> runs_s{};
  for (double& run_s : runs_s) {
    const auto start = std::chrono::steady_clock::now();
    (void)hits_of(packets, kRows * blocks, scene);
    run_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::ranges::sort(runs_s);
  trace.seconds = runs_s[1];
  return trace;
}

}  // namespace thermal
