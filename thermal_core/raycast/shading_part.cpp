#include "raycast/shading_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr double kLeastRise = 0.026186;  // tangent of 1.5 degrees
constexpr double kTileM = 32;
constexpr double kRoundingM = 0.05;

using Point = std::array<double, 3>;

/// Bounds of an object that casts a shadow on the ground, and its top.
struct Extent {
  std::array<double, 2> low_m = {std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
  std::array<double, 2> high_m = {-std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  double top_m = -std::numeric_limits<double>::infinity();

  void add(const Point& point_m) noexcept {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low_m[axis] = std::min(low_m[axis], point_m[axis]);
      high_m[axis] = std::max(high_m[axis], point_m[axis]);
    }
    top_m = std::max(top_m, point_m[2]);
  }
};

/// A sun near the horizon.
struct LowSun {
  std::array<double, 2> towards{};  ///< horizontal unit vector
  double rise = 0;                  ///< tangent of its elevation
};

std::vector<LowSun> low_among(std::span<const EastNorthUp> suns) {
  std::vector<LowSun> low;
  for (const auto& [east, north, up] : suns) {
    const double level = std::sqrt(east * east + north * north);
    if (up > 0 && up < kLeastRise * level)
      low.push_back({.towards = {east / level, north / level}, .rise = up / level});
  }
  return low;
}

/// Per tile of a scene, the height above which objects are relevant.
class RelevantHeights {
 public:
  RelevantHeights(double size_m, std::span<const RayStart> starts, std::span<const EastNorthUp> suns)
      : tiles_(static_cast<std::size_t>(std::clamp(std::ceil(size_m / kTileM), 1.0, 256.0))),
        half_m_(size_m / 2),
        tile_m_(size_m / static_cast<double>(tiles_)),
        per_m_(1 / tile_m_),
        from_m_(tiles_ * tiles_) {
    const std::vector<LowSun> low = low_among(suns);
    parallel_for(from_m_.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t tile = begin; tile < end; ++tile) {
        double from_m = std::numeric_limits<double>::infinity();
        for (const RayStart& start : starts) from_m = std::min(from_m, from_height_m(tile, start, low));
        from_m_[tile] = from_m;
      }
    });
  }

  [[nodiscard]] bool matters(const Extent& extent) const noexcept {
    std::array<std::array<std::size_t, 2>, 2> range{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!(extent.low_m[axis] >= -half_m_ && extent.high_m[axis] <= half_m_)) return true;  // no tile
      range[axis] = {tile_at(extent.low_m[axis]), tile_at(extent.high_m[axis])};
    }
    for (std::size_t row = range[1][0]; row <= range[1][1]; ++row)
      for (std::size_t column = range[0][0]; column <= range[0][1]; ++column)
        if (extent.top_m > from_m_[row * tiles_ + column]) return true;
    return false;
  }

 private:
  [[nodiscard]] std::size_t tile_at(double place_m) const noexcept {
    return std::min(static_cast<std::size_t>((place_m + half_m_) * per_m_), tiles_ - 1);
  }

  /// Height above which objects in a tile are relevant to a start.
  [[nodiscard]] double from_height_m(std::size_t tile, const RayStart& start,
                                     const std::vector<LowSun>& suns) const noexcept {
    const std::array<std::size_t, 2> number = {tile % tiles_, tile / tiles_};
    std::array<double, 2> least_m{};  // of the vectors from the start to the tile
    std::array<double, 2> most_m{};
    double square = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double low_m = tile_m_ * static_cast<double>(number[axis]) - half_m_ - kRoundingM;
      least_m[axis] = low_m - start.high_m[axis];
      most_m[axis] = low_m + tile_m_ + 2 * kRoundingM - start.low_m[axis];
      const double gap_m = std::max({0.0, least_m[axis], -most_m[axis]});
      square += gap_m * gap_m;
    }
    double above_m = kLeastRise * std::sqrt(square);
    for (const LowSun& sun : suns)
      above_m = std::min(above_m, sun.rise * distance_m(sun.towards, least_m, most_m));
    return start.height_m + above_m - kRoundingM;
  }

  /// Distance from the origin to a rectangle in a direction; infinite if the ray misses it.
  static double distance_m(const std::array<double, 2>& towards, const std::array<double, 2>& least_m,
                           const std::array<double, 2>& most_m) noexcept {
    constexpr double kParallel = 1e-9;
    double enter_m = 0;
    double leave_m = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (std::abs(towards[axis]) < kParallel) {
        if (least_m[axis] > 0 || most_m[axis] < 0) return std::numeric_limits<double>::infinity();
        continue;
      }
      const auto [near_m, far_m] = std::minmax({least_m[axis] / towards[axis], most_m[axis] / towards[axis]});
      enter_m = std::max(enter_m, near_m);
      leave_m = std::min(leave_m, far_m);
    }
    return enter_m <= leave_m ? enter_m : std::numeric_limits<double>::infinity();
  }

  std::size_t tiles_;  ///< along a side
  double half_m_;
  double tile_m_;
  double per_m_;                ///< tiles
  std::vector<double> from_m_;  ///< [row of y, column of x]
};

Point as_point(const std::array<float, 3>& point_m) noexcept {
  return {static_cast<double>(point_m[0]), static_cast<double>(point_m[1]), static_cast<double>(point_m[2])};
}

Extent extent_of(const BakedMesh& mesh, const std::array<std::uint32_t, 3>& corners) noexcept {
  Extent extent;
  for (const std::uint32_t corner : corners) extent.add(as_point(mesh.points_m[corner]));
  return extent;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const BakedMesh& mesh,
                                                       const RelevantHeights& heights) {
  constexpr std::size_t kChunk = std::size_t{1} << 16U;
  std::vector<std::vector<std::array<std::uint32_t, 3>>> chunks((mesh.triangles.size() + kChunk - 1) /
                                                                kChunk);
  parallel_for(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      for (const auto& corners :
           mesh.triangles.subspan(k * kChunk, std::min(kChunk, mesh.triangles.size() - k * kChunk)))
        if (heights.matters(extent_of(mesh, corners))) chunks[k].push_back(corners);
    }
  });
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& chunk : chunks) triangles.insert(triangles.end(), chunk.begin(), chunk.end());
  return triangles;
}

/// The corners of a box around a mesh.
std::array<Point, 8> box_around(const BakedMesh& mesh) noexcept {
  Point low_m{};
  Point high_m{};
  for (std::size_t axis = 0; axis < 3 && !mesh.points_m.empty(); ++axis) {
    const auto [low, high] =
        std::ranges::minmax(mesh.points_m, {}, [axis](const auto& point_m) { return point_m[axis]; });
    low_m[axis] = static_cast<double>(low[axis]);
    high_m[axis] = static_cast<double>(high[axis]);
  }
  std::array<Point, 8> corners{};
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[k][axis] = (k >> axis & 1U) != 0 ? high_m[axis] : low_m[axis];
  return corners;
}

Extent extent_of(const std::array<Point, 8>& box_m, const Transform<double>& m) noexcept {
  Extent extent;
  for (const auto& [x, y, z] : box_m)
    extent.add({m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
                m[8] * x + m[9] * y + m[10] * z + m[11]});
  return extent;
}

}  // namespace

ShadingPart::ShadingPart(const BakedScene& scene, double size_m, std::span<const RayStart> starts,
                         std::span<const EastNorthUp> suns) {
  const RelevantHeights heights(size_m, starts, suns);
  for (const BakedSurface& surface : scene.surfaces) {
    const BakedMesh& mesh = scene.meshes[surface.mesh];
    triangles_.push_back(triangles_of(mesh, heights));
    if (triangles_.back().empty()) continue;
    part_.surfaces.push_back({.object = surface.object, .mesh = part_.meshes.size()});
    part_.meshes.push_back(
        {.name = mesh.name, .points_m = mesh.points_m, .triangles = triangles_.back(), .material_index = {}});
  }
  std::map<std::uint32_t, std::uint32_t> numbers;  // index of a mesh in the part, by that in the scene
  std::map<std::uint32_t, std::array<Point, 8>> boxes_m;
  for (const BakedPlants& plants : scene.plants) {
    auto& transforms = transforms_.emplace_back();
    auto& meshes = plant_meshes_.emplace_back();
    for (std::size_t k = 0; k < plants.mesh.size(); ++k) {
      const BakedMesh& mesh = scene.meshes[plants.mesh[k]];
      const auto [box_m, is_first] = boxes_m.try_emplace(plants.mesh[k]);
      if (is_first) box_m->second = box_around(mesh);
      if (!heights.matters(extent_of(box_m->second, plants.transform[k]))) continue;
      const auto [number, is_new] =
          numbers.try_emplace(plants.mesh[k], static_cast<std::uint32_t>(part_.meshes.size()));
      if (is_new)
        part_.meshes.push_back({.name = mesh.name,
                                .points_m = mesh.points_m,
                                .triangles = mesh.triangles,
                                .material_index = {}});
      transforms.push_back(plants.transform[k]);
      meshes.push_back(number->second);
    }
    part_.plants.push_back(
        {.name = plants.name, .object = plants.object, .transform = transforms, .mesh = meshes});
  }
}

}  // namespace thermal
