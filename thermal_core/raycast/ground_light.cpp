#include "raycast/ground_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>

#include "base/clones.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "raycast/embree.h"
#include "raycast/ray_caster.h"
#include "raycast/scene_accelerator.h"
#include "raycast/shading_part.h"

namespace thermal {
namespace {

constexpr std::size_t kAzimuths = 2048;

/// The preceding Fibonacci number.
std::size_t one_before(std::size_t number) noexcept {
  std::size_t before = 1;
  std::size_t last = 2;
  while (last < number) {
    before += last;
    std::swap(before, last);
  }
  assert(last == number);
  return before;
}

/// Unit vectors at kAzimuths angles, by repeated halving.
std::vector<std::array<float, 2>> circle() {
  std::vector<std::array<double, 2>> corners = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  while (corners.size() < kAzimuths) {
    std::vector<std::array<double, 2>> finer;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto& next = corners[(k + 1) % corners.size()];
      const double x = corners[k][0] + next[0];
      const double y = corners[k][1] + next[1];
      const double size = std::sqrt(x * x + y * y);
      finer.push_back(corners[k]);
      finer.push_back({x / size, y / size});
    }
    corners = std::move(finer);
  }
  std::vector<std::array<float, 2>> rounded;
  for (const auto& [x, y] : corners) rounded.push_back({static_cast<float>(x), static_cast<float>(y)});
  return rounded;
}

/// A vector between points of the lattice, in parts of its length.
struct Step {
  int u = 0;
  int v = 0;

  [[nodiscard]] int square() const noexcept { return u * u + v * v; }
};

/// The two shortest vectors of a lattice, which span its cell.
std::array<Step, 2> shortest_steps(int count, int step) {
  const auto nearest = [count](int one) { return 2 * one > count ? one - count : one; };
  std::vector<Step> steps;
  for (int k = 1; k < count; ++k) steps.push_back({.u = nearest(k), .v = nearest(k * step % count)});
  std::ranges::stable_sort(steps, {}, &Step::square);
  const Step first = steps.front();
  const auto second = std::ranges::find_if(steps, [count, first](const Step& other) {
    return std::abs(first.u * other.v - first.v * other.u) == count;
  });
  return {first, *second};
}

/// Fractional part, from 0 to less than 1.
VELDT_INLINE float wrapped(float number) noexcept {
  const float rest = number - std::floor(number);
  return rest < 1 ? rest : 0;  // a small negative number would be rounded up to 1
}

}  // namespace

SkyRays::SkyRays(std::size_t count) : circle_(circle()) {
  const std::size_t step = one_before(count);
  const auto share = [count](auto number) {
    return static_cast<float>(static_cast<double>(number) / static_cast<double>(count));
  };
  for (std::size_t k = 0; k < count; ++k) points_.push_back({.u = share(k), .v = share(k * step % count)});
  const auto sides = shortest_steps(static_cast<int>(count), static_cast<int>(step));
  for (std::size_t k = 0; k < sides.size(); ++k) sides_[k] = {.u = share(sides[k].u), .v = share(sides[k].v)};
}

VectorLanes<float> SkyRays::at(std::size_t k, const Shift& shift) const noexcept {
  VectorLanes<float> out;  // NOLINT(cppcoreguidelines-pro-type-member-init): all lanes are filled in
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const float a = shift[0][lane];
    const float b = shift[1][lane];
    const float u = wrapped(points_[k].u + a * sides_[0].u + b * sides_[1].u);
    const float v = wrapped(points_[k].v + a * sides_[0].v + b * sides_[1].v);
    const auto& [x, y] = circle_[static_cast<std::size_t>(v * static_cast<float>(kAzimuths))];
    const float sine = std::sqrt(u);
    out[0][lane] = sine * x;
    out[1][lane] = sine * y;
    out[2][lane] = std::sqrt(1 - u);
  }
  return out;
}

namespace {

static_assert(kLanes == kPacketRays);
static_assert(kBlockCells * kBlockCells == kLanes);

/// Rays start this far above the ground [m]: more than the rounding of positions 5 km from the origin.
constexpr float kLiftM = 0.01F;

constexpr float kFarthestCellM = 1e9F;  // from the origin: Embree ends the program at huge numbers

/// Cells that are traced together. At the map's border, some are repeated.
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
    const std::size_t row = std::min(first_row + k / kBlockCells, maps.cells - 1);
    const std::size_t column = std::min(first_column + k % kBlockCells, maps.cells - 1);
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

/// The hours of a day in which the sun is up.
std::uint32_t hours_of(const SunHours& sun) noexcept {
  std::uint32_t hours = 0;
  for (std::size_t hour = 0; hour < sun.size(); ++hour) hours |= (sun[hour][2] > 0 ? 1U : 0U) << hour;
  return hours;
}

class LightTracer {
 public:
  LightTracer(const SceneAccelerator& accelerator, std::span<const SunDay> days, const BlockRays& rays,
              GroundMaps& maps)
      : scene_(accelerator.surroundings().scene.get()), days_(days), rays_(rays), maps_(maps) {
    for (const std::size_t count : rays)
      if (count > 0) sky_.try_emplace(count, count);
  }

  void trace(std::size_t number) const {
    const std::size_t side = blocks_along(maps_.cells);
    const Block block = block_at(maps_, number / side * kBlockCells, number % side * kBlockCells);
    trace_sky(block, sky_.at(rays_[number]));
    for (std::size_t day = 0; day < days_.size(); ++day) trace_day(block, days_[day], maps_.sunlit[day]);
  }

 private:
  void trace_sky(const Block& block, const SkyRays& sky) const {
    Lanes<std::size_t> seen{};
    for (std::size_t ray = 0; ray < sky.count(); ++ray) {
      const unsigned reached = reach_sky(scene_, block, sky.at(ray, block.shift));
      for (std::size_t k = 0; k < kLanes; ++k) seen[k] += reached >> k & 1U;
    }
    for (std::size_t k = 0; k < kLanes; ++k)
      maps_.sky_view[block.cells[k]] =
          static_cast<std::uint8_t>((2 * 255 * seen[k] + sky.count()) / (2 * sky.count()));
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
  const BlockRays& rays_;
  std::map<std::size_t, SkyRays> sky_;  ///< by their count
  GroundMaps& maps_;
};

/// Start points of the traced blocks' rays, by squares of blocks.
std::vector<RayStart> starts_of(const GroundMaps& maps, const BlockRays& rays) {
  constexpr std::size_t kSquareBlocks = 8;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const std::size_t side = blocks_along(maps.cells);
  const std::size_t squares = (side + kSquareBlocks - 1) / kSquareBlocks;
  std::vector<RayStart> starts(
      squares * squares,
      {.low_m = {kEndless, kEndless}, .high_m = {-kEndless, -kEndless}, .height_m = kEndless});
  for (std::size_t cell = 0; cell < maps.height_m.size(); ++cell) {
    const std::array<std::size_t, 2> number = {cell % maps.cells, cell / maps.cells};
    if (rays[number[1] / kBlockCells * side + number[0] / kBlockCells] == 0) continue;
    constexpr std::size_t kSquareCells = kSquareBlocks * kBlockCells;
    RayStart& start = starts[number[1] / kSquareCells * squares + number[0] / kSquareCells];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double place_m = cell_middle_m(maps.size_m, maps.cells, number[axis]);
      start.low_m[axis] = std::min(start.low_m[axis], place_m);
      start.high_m[axis] = std::max(start.high_m[axis], place_m);
    }
    start.height_m = std::min(start.height_m, static_cast<double>(maps.height_m[cell]));
  }
  std::erase_if(starts, [](const RayStart& start) { return start.height_m == kEndless; });
  return starts;
}

std::vector<EastNorthUp> suns_of(std::span<const SunDay> days) {
  std::vector<EastNorthUp> suns;
  for (const SunDay& day : days) suns.insert(suns.end(), day.sun.begin(), day.sun.end());
  return suns;
}

/// Number of a block's cells within the maps.
std::size_t cells_in(std::size_t number, std::size_t cells) noexcept {
  const std::size_t side = blocks_along(cells);
  const auto along = [cells](std::size_t block) {
    return std::min(kBlockCells, cells - block * kBlockCells);
  };
  return along(number / side) * along(number % side);
}

/// Heights; 0 where no ground is drawn.
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
          .ash = copy_of(ground.ash),
          .border = copy_of(ground.border)};
}

}  // namespace

BlockRays rays_for(const std::vector<float>& finest_pixels_m, double cell_m) {
  // A pixel averages cells over at least two thirds of its width: 4, 16 or 64 cells.
  const auto rays = [cell_m](float pixel_m) -> std::size_t {
    if (!std::isfinite(pixel_m)) return 0;
    const double cells = static_cast<double>(pixel_m) / cell_m;
    return cells < 3 ? kSkyRays : cells < 6 ? 34 : cells < 12 ? 13 : 8;
  };
  BlockRays counts;
  for (const float pixel_m : finest_pixels_m) counts.push_back(rays(pixel_m));
  return counts;
}

void trace_ground_light(const RayCaster& caster, std::span<const SunDay> days, const BlockRays& rays,
                        GroundMaps& maps, const ShowCells& show) {
  constexpr std::size_t kParts = 50;
  constexpr std::size_t kLeastPart = 1024;
  constexpr std::size_t kGrain = 16;
  const std::size_t cells = maps.cells * maps.cells;
  maps.sky_view.assign(cells, 255);
  maps.sunlit.clear();
  for (const SunDay& day : days)
    maps.sunlit.push_back({.path = day.path, .hours = std::vector<std::uint32_t>(cells, hours_of(day.sun))});
  std::vector<std::size_t> blocks;
  std::size_t total = 0;
  for (std::size_t number = 0; number < rays.size(); ++number) {
    if (rays[number] == 0) continue;
    blocks.push_back(number);
    total += cells_in(number, maps.cells);
  }
  const LightTracer tracer(caster.accelerator(), days, rays, maps);
  const std::size_t part = std::max(kLeastPart, blocks.size() / kParts);
  std::size_t done = 0;
  for (std::size_t first = 0; first < blocks.size(); first += part) {
    const auto now = std::span(blocks).subspan(first, std::min(part, blocks.size() - first));
    parallel_for(now.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (const std::size_t number : now.subspan(begin, end - begin)) tracer.trace(number);
    });
    for (const std::size_t number : now) done += cells_in(number, maps.cells);
    if (show) show(static_cast<int>(done), static_cast<int>(total));
  }
}

GroundMaps make_ground_maps(const BakedScene& scene, std::span<const SunDay> days,
                            const std::optional<std::vector<GroundView>>& views, const ShowCells& show) {
  GroundMaps maps;
  maps.size_m = scene.ground.size_m;
  maps.cells = ground_map_cells(maps.size_m);
  maps.moisture = ground_moisture(scene.ground, maps.cells);
  maps.covers = covers_of(scene.ground);
  fill_heights(top_heights(scene, maps.size_m, maps.cells), maps);
  maps.water_m = water_depths_m(scene.ground, maps.height_m, maps.cells);
  const std::size_t blocks = blocks_along(maps.cells) * blocks_along(maps.cells);
  const BlockRays rays =
      views ? rays_for(finest_pixels_m(scene, maps, *views), maps.size_m / static_cast<double>(maps.cells))
            : BlockRays(blocks, kSkyRays);
  const ShadingPart part(scene, maps.size_m, starts_of(maps, rays), suns_of(days));
  trace_ground_light(RayCaster(part.scene()), days, rays, maps, show);
  return maps;
}

}  // namespace thermal
