#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "raycast/sight.h"
#include "scene/baked_scene.h"
#include "scene/ground_maps.h"
#include "scene/seen_ground.h"

namespace thermal {

/// Directions above the horizon, distributed as the cosine from the vertical: their projections onto the unit disc are
/// spread evenly. The share of them that is not blocked estimates the sky view.
///
/// The set is a lattice in (u, v) = (sine of the angle from the vertical, squared; azimuth in turns), of k / n and
/// frac(k g / n) with consecutive Fibonacci numbers g and n. A lane shifts it by a vector of the lattice's own cell, so
/// that direction k of all lanes lies in one cell: rays of a packet stay together, and errors of cells are independent
/// of each other. Bits do not depend on the C library: only +, -, *, / and square roots.
class SkyRays {
 public:
  /// @param count  a Fibonacci number from 8 to 2584
  explicit SkyRays(std::size_t count);

  [[nodiscard]] std::size_t count() const noexcept { return points_.size(); }

  /// Shift of each lane within the lattice's cell, from 0 to less than 1 along both sides.
  using Shift = std::array<Lanes<float>, 2>;

  /// Direction k of each lane: unit vectors.
  [[nodiscard]] VectorLanes<float> at(std::size_t k, const Shift& shift) const noexcept;

 private:
  struct Point {
    float u = 0;
    float v = 0;
  };

  std::vector<Point> points_;
  std::array<Point, 2> sides_;                ///< of the lattice's cell
  std::vector<std::array<float, 2>> circle_;  ///< unit vectors, by azimuth
};

class RayCaster;

/// A day whose hours of sunlight are computed.
struct SunDay {
  SunPath path;
  SunHours sun{};  ///< unit vectors; where `up` is not positive, it is night
};

/// Rays for the sky view of a cell, a Fibonacci number (SkyRays). Root-mean-square error: see ACCURACY.md.
inline constexpr std::size_t kSkyRays = 89;

/// Rays for the sky view of the cells of each block, [row of y, column of x]; 0: the cells are not traced.
using BlockRays = std::vector<std::size_t>;

/// Rays per block, by the finest pixels that show it: fewer where pixels average many cells, for the same error of
/// their means; 0 where no pixel shows it.
[[nodiscard]] BlockRays rays_for(const std::vector<float>& finest_pixels_m, double cell_m);

/// Called with the numbers of finished and all cells; on the calling thread.
using ShowCells = std::function<void(int done, int total)>;

/// Fills in sky_view and sunlit of maps with area and heights, by rays that start 1 cm above the middle of each cell
/// and end at anything they hit: ground, water, crowns. The sun is a point. A cell that is not traced, or not within
/// 1e9 m of the origin, gets full sky view and sunlight. Only whether a ray hits anything counts, so ties between
/// triangles do not matter. The result depends on nothing else, such as threads or the processor's vectors.
void trace_ground_light(const RayCaster& caster, std::span<const SunDay> days, const BlockRays& rays,
                        GroundMaps& maps, const ShowCells& show = {});

/// All maps of a scene, on all cores. Light is traced where `views` may show it; without `views`, everywhere. Error if
/// there is not enough memory.
[[nodiscard]] GroundMaps make_ground_maps(const BakedScene& scene, std::span<const SunDay> days,
                                          const std::optional<std::vector<GroundView>>& views = {},
                                          const ShowCells& show = {});

}  // namespace thermal
