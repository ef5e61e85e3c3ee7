#include "raycast/ground_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"
#include "base/rng.h"
#include "raycast/embree.h"
#include "raycast/place.h"
#include "raycast/ray_caster.h"
#include "raycast/sky_rays.h"
#include "scene/ground_moisture.h"
#include "scene/top_heights.h"

namespace thermal {
namespace {

static_assert(kLanes == kPacketRays);
constexpr std::size_t kBlock = 4;  // cells along a side of those that are traced together
static_assert(kBlock * kBlock == kLanes);

/// Rays start this far above the ground [m]: more than the rounding of positions 5 km from the origin.
constexpr float kLiftM = 0.01F;

constexpr float kFarthestCellM = 1e9F;  // from the origin: Embree ends the program at huge numbers

/// Cells that are traced together. At the map's border, cells are in it more than once.
struct Block {
  Lanes<std::size_t> cells{};
  RTCRay16 start{};  ///< without directions
  SkyRays::Shift shift{};
};

/// The random numbers of a cell: the same on every machine, and for every scene.
std::array<float, 2> shift_of(std::size_t row, std::size_t column) noexcept {
  constexpr Philox4x32::Key kKey = {0x736B79, 0};
  const auto words =
      Philox4x32::generate({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), 0, 0}, kKey);
  const auto unit = [](std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24F; };
  return {unit(words[0]), unit(words[1])};
}

Block block_at(const GroundMaps& maps, std::size_t first_row, std::size_t first_column) noexcept {
  Block block;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const std::size_t row = std::min(first_row + k / kBlock, maps.cells - 1);
    const std::size_t column = std::min(first_column + k % kBlock, maps.cells - 1);
    const std::size_t cell = row * maps.cells + column;
    block.cells[k] = cell;
    const auto x_m = static_cast<float>(cell_middle_m(maps.size_m, maps.cells, column));
    const auto y_m = static_cast<float>(cell_middle_m(maps.size_m, maps.cells, row));
    const float z_m = maps.height_m[cell] + kLiftM;
    const bool is_valid = std::abs(x_m) + std::abs(y_m) + std::abs(z_m) < kFarthestCellM;
    block.start.org_x[k] = is_valid ? x_m : 0;
    block.start.org_y[k] = is_valid ? y_m : 0;
    block.start.org_z[k] = is_valid ? z_m : 0;
    block.start.tfar[k] = is_valid ? std::numeric_limits<float>::infinity() : -1;
    block.start.mask[k] = ~0U;
    const auto [a, b] = shift_of(row, column);
    block.shift[0][k] = a;
    block.shift[1][k] = b;
  }
  return block;
}

/// Which rays from a block reach the sky: bit k is that of lane k.
unsigned reach_sky(RTCScene scene, const Block& block, const VectorLanes<float>& direction) noexcept {
  alignas(RayPacket) PacketMask mask;
  mask.fill(-1);
  RTCRay16 rays = block.start;
  std::ranges::copy(direction[0], rays.dir_x);
  std::ranges::copy(direction[1], rays.dir_y);
  std::ranges::copy(direction[2], rays.dir_z);
  find_any(scene, mask, rays);
  unsigned reached = 0;
  for (std::size_t k = 0; k < kLanes; ++k) reached |= (rays.tfar[k] == block.start.tfar[k] ? 1U : 0U) << k;
  return reached;
}

VectorLanes<float> same_for_all(const EastNorthUp& direction) noexcept {
  VectorLanes<float> lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) lanes[axis].fill(static_cast<float>(direction[axis]));
  return lanes;
}

class LightTracer {
 public:
  LightTracer(const Place& place, std::span<const SunDay> days, std::size_t sky_rays, GroundMaps& maps)
      : scene_(place.surroundings().scene.get()), days_(days), sky_(sky_rays), maps_(maps) {}

  void trace(std::size_t row, std::size_t column) const {
    const Block block = block_at(maps_, row, column);
    trace_sky(block);
    for (std::size_t day = 0; day < days_.size(); ++day) trace_day(block, days_[day], maps_.sunlit[day]);
  }

 private:
  void trace_sky(const Block& block) const {
    Lanes<std::size_t> seen{};
    for (std::size_t ray = 0; ray < sky_.count(); ++ray) {
      const unsigned reached = reach_sky(scene_, block, sky_.at(ray, block.shift));
      for (std::size_t k = 0; k < kLanes; ++k) seen[k] += reached >> k & 1U;
    }
    for (std::size_t k = 0; k < kLanes; ++k)
      maps_.sky_view[block.cells[k]] =
          static_cast<std::uint8_t>((2 * 255 * seen[k] + sky_.count()) / (2 * sky_.count()));
  }

  void trace_day(const Block& block, const SunDay& day, SunlitHours& out) const {
    Lanes<std::uint32_t> hours{};
    for (std::size_t hour = 0; hour < day.sun.size(); ++hour) {
      if (!(day.sun[hour][2] > 0)) continue;
      const unsigned reached = reach_sky(scene_, block, same_for_all(day.sun[hour]));
      for (std::size_t k = 0; k < kLanes; ++k) hours[k] |= (reached >> k & 1U) << hour;
    }
    for (std::size_t k = 0; k < kLanes; ++k) out.hours[block.cells[k]] = hours[k];
  }

  RTCScene scene_;
  std::span<const SunDay> days_;
  SkyRays sky_;
  GroundMaps& maps_;
};

/// Where no ground is drawn, its height is 0.
void fill_heights(const TopHeights& tops, GroundMaps& maps) {
  maps.height_m = tops.ground_m;
  maps.crown_top_m.resize(maps.height_m.size());
  for (std::size_t k = 0; k < maps.height_m.size(); ++k) {
    if (!std::isfinite(maps.height_m[k])) maps.height_m[k] = 0;
    maps.crown_top_m[k] = std::max(0.0F, tops.plants_m[k] - maps.height_m[k]);
  }
}

std::vector<std::uint8_t> copy_of(std::span<const std::uint8_t> values) {
  return {values.begin(), values.end()};
}

GroundCovers covers_of(const BakedGround& ground) {
  return {.cells = ground.fine_cells,
          .kinds = ground.covers,
          .kind = copy_of(ground.kind),
          .grass = copy_of(ground.grass),
          .trodden = copy_of(ground.trodden),
          .ash = copy_of(ground.ash)};
}

}  // namespace

void trace_ground_light(const RayCaster& caster, std::span<const SunDay> days, GroundMaps& maps,
                        std::size_t sky_rays, const ShowParts& show) {
  constexpr int kParts = 50;
  constexpr std::size_t kGrain = 16;
  const std::size_t cells = maps.cells * maps.cells;
  maps.sky_view.assign(cells, 0);
  maps.sunlit.clear();
  for (const SunDay& day : days)
    maps.sunlit.push_back({.path = day.path, .hours = std::vector<std::uint32_t>(cells)});
  const LightTracer tracer(caster.place(), days, sky_rays, maps);
  const std::size_t side = (maps.cells + kBlock - 1) / kBlock;
  for (int part = 0; part < kParts; ++part) {
    const std::size_t first = side * side * static_cast<std::size_t>(part) / kParts;
    const std::size_t last = side * side * static_cast<std::size_t>(part + 1) / kParts;
    parallel_for(last - first, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = first + begin; block < first + end; ++block)
        tracer.trace(block / side * kBlock, block % side * kBlock);
    });
    if (show) show(part + 1, kParts);
  }
}

GroundMaps make_ground_maps(const BakedScene& scene, std::span<const SunDay> days, const ShowParts& show) {
  GroundMaps maps;
  maps.size_m = scene.ground.size_m;
  maps.cells = ground_map_cells(maps.size_m);
  maps.moisture = ground_moisture(scene.ground, maps.cells);
  maps.covers = covers_of(scene.ground);
  fill_heights(top_heights(scene, maps.size_m, maps.cells), maps);
  trace_ground_light(RayCaster(scene), days, maps, kSkyRays, show);
  return maps;
}

}  // namespace thermal
