#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/image.h"
#include "raycast/embree.h"
#include "raycast/pixel_rays.h"
#include "raycast/scene_accelerator.h"
#include "raycast/sight.h"
#include "scene/passes.h"

namespace thermal {

static_assert(kLanes == kPacketRays);
inline constexpr unsigned kNothing = RTC_INVALID_GEOMETRY_ID;

/// Rays that are traced together, and the positions of their results.
struct Packet {
  void add(const LensPoint& ray, std::size_t place) noexcept {
    mask[rays] = -1;
    x[rays] = ray.x;
    y[rays] = ray.y;
    places[rays] = place;
    ++rays;
  }
  [[nodiscard]] bool is_full() const noexcept { return rays == kLanes; }

  alignas(RayPacket) PacketMask mask{};
  Lanes<double> x{};
  Lanes<double> y{};
  Lanes<std::size_t> places{};
  std::size_t rays = 0;
  bool near_actors = false;
};

/// The pixels of a packet: 4 x 4, fewer at the right and lower border.
inline constexpr int kBlockPx = 4;
static_assert(kBlockPx * kBlockPx == static_cast<int>(kLanes));

[[nodiscard]] Packet block_at(int x_px, int y_px, const PixelRays& rays,
                              const Plane<std::uint8_t>& near_actors);

/// Embree's rays for directions(). As in Cycles, a ray has unit length and starts at the nearest depth, in single
/// precision: silhouettes then agree to 1e-4 px. Invalid rays hit nothing.
[[nodiscard]] RayPacket aimed(const View& view, const VectorLanes<double>& direction,
                              const std::array<double, 2>& depth_range_m) noexcept;

/// The same with a nearest depth for each ray.
[[nodiscard]] RayPacket aimed(const View& view, const VectorLanes<double>& direction,
                              const Lanes<double>& nearest_m, double farthest_m) noexcept;

/// Fills the planes of `out` that are needed, and both indices. `near_actors`: pixels whose ray may hit an actor.
void trace_pixels(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                  const PassNeeds& needs, Passes& out);

/// Fills the lists of `fine` that are needed, and both indices; its pixels are set. `rays` are those of samples,
/// `near_actors` of pixels.
void trace_samples(const Shot& shot, const PixelRays& rays, const Plane<std::uint8_t>& near_actors,
                   const PassNeeds& needs, FineSamples& fine);

}  // namespace thermal
