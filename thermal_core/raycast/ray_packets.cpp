#include "raycast/ray_packets.h"

#include <algorithm>
#include <cmath>

namespace thermal {
namespace {

constexpr float kFarthestCameraM = 1e9F;  // from the origin; farther away it sees nothing

/// False for NaN.
bool is_valid(const RayPacket& packet, std::size_t k) noexcept {
  const float place_m =
      std::abs(packet.ray.org_x[k]) + std::abs(packet.ray.org_y[k]) + std::abs(packet.ray.org_z[k]);
  const float size =
      std::abs(packet.ray.dir_x[k]) + std::abs(packet.ray.dir_y[k]) + std::abs(packet.ray.dir_z[k]);
  return place_m < kFarthestCameraM && size < 2;
}

/// Disables a ray. Embree ends the program at NaN and at huge numbers; and its version 3 ignores the mask of packets
/// that are larger than the vectors of the instruction set.
void end_at_once(RayPacket& packet, std::size_t k) noexcept {
  packet.ray.org_x[k] = packet.ray.org_y[k] = packet.ray.org_z[k] = 0;
  packet.ray.dir_x[k] = packet.ray.dir_y[k] = 0;
  packet.ray.dir_z[k] = 1;
  packet.ray.tfar[k] = -1;
}

}  // namespace

Packet block_at(int x_px, int y_px, const PixelRays& rays, const Plane<std::uint8_t>& near_actors) {
  Packet packet;
  const auto width = static_cast<std::size_t>(rays.width_px());
  for (int y = y_px; y < std::min(y_px + kBlockPx, rays.height_px()); ++y) {
    for (int x = x_px; x < std::min(x_px + kBlockPx, rays.width_px()); ++x) {
      const auto column = static_cast<std::size_t>(x);
      const auto row = static_cast<std::size_t>(y);
      packet.add(rays.at(column, row), row * width + column);
      packet.near_actors |= near_actors.at(x, y) != 0;
    }
  }
  return packet;
}

RayPacket aimed(const View& view, const VectorLanes<double>& direction,
                const std::array<double, 2>& depth_range_m) noexcept {
  Lanes<double> nearest_m{};
  nearest_m.fill(depth_range_m[0]);
  return aimed(view, direction, nearest_m, depth_range_m[1]);
}

RayPacket aimed(const View& view, const VectorLanes<double>& direction, const Lanes<double>& nearest_m,
                double farthest_m) noexcept {
  const UnitLanes unit = units(direction);
  const auto x_m = static_cast<float>(view.position_m.x);
  const auto y_m = static_cast<float>(view.position_m.y);
  const auto z_m = static_cast<float>(view.position_m.z);
  RayPacket packet;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto start_m = static_cast<float>(nearest_m[k] * unit.length[k]);
    packet.ray.org_x[k] = x_m + start_m * unit.direction[0][k];
    packet.ray.org_y[k] = y_m + start_m * unit.direction[1][k];
    packet.ray.org_z[k] = z_m + start_m * unit.direction[2][k];
    packet.ray.dir_x[k] = unit.direction[0][k];
    packet.ray.dir_y[k] = unit.direction[1][k];
    packet.ray.dir_z[k] = unit.direction[2][k];
    packet.ray.tnear[k] = 0;
    packet.ray.tfar[k] = static_cast<float>((farthest_m - nearest_m[k]) * unit.length[k]);
    packet.ray.time[k] = 0;
    packet.ray.mask[k] = ~0U;
    packet.ray.id[k] = static_cast<unsigned>(k);
    packet.ray.flags[k] = 0;
    packet.hit.geomID[k] = kNothing;
    packet.hit.instID[0][k] = kNothing;
    if (!is_valid(packet, k)) end_at_once(packet, k);
  }
  return packet;
}

}  // namespace thermal
