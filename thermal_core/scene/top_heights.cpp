#include "scene/top_heights.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "scene/ground_maps.h"

namespace thermal {
namespace {

using Corner = std::array<double, 3>;

constexpr float kNone = -std::numeric_limits<float>::infinity();

/// The higher of both, in any order of threads.
void raise(float& height_m, float to_m) noexcept {
  const std::atomic_ref<float> shared(height_m);
  float before_m = shared.load(std::memory_order_relaxed);
  while (before_m < to_m && !shared.compare_exchange_weak(before_m, to_m, std::memory_order_relaxed)) {
  }
}

/// Twice the area of a triangle of a middle and two corners, exactly negated if these are swapped.
double area_m2(double x_m, double y_m, const Corner& a, const Corner& b) noexcept {
  return (a[0] - x_m) * (b[1] - y_m) - (a[1] - y_m) * (b[0] - x_m);
}

/// Raises the heights of a map.
class Raster {
 public:
  Raster(double size_m, std::size_t cells, std::span<float> heights_m) noexcept
      : size_m_(size_m),
        cells_(cells),
        per_m_(static_cast<double>(cells) / size_m),
        origin_(0.5 * static_cast<double>(cells) - 0.5),
        heights_m_(heights_m) {}

  void add(const Corner& a, const Corner& b, const Corner& c) const noexcept {
    const Range columns = middles_between(std::min({a[0], b[0], c[0]}), std::max({a[0], b[0], c[0]}));
    if (columns.begin >= columns.end) return;
    const Range rows = middles_between(std::min({a[1], b[1], c[1]}), std::max({a[1], b[1], c[1]}));
    for (std::size_t row = rows.begin; row < rows.end; ++row)
      for (std::size_t column = columns.begin; column < columns.end; ++column) put(row, column, a, b, c);
  }

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// Range of the rows or columns whose middle is between two coordinates, with a tolerance for rounding.
  [[nodiscard]] Range middles_between(double least_m, double most_m) const noexcept {
    constexpr double kRounding = 1e-6;  // of a cell
    const auto cells = static_cast<double>(cells_);
    const double first = least_m * per_m_ + origin_ - kRounding;
    const double last = most_m * per_m_ + origin_ + kRounding;
    if (!(first <= last && first < cells && last >= 0)) return {};
    const auto below = static_cast<std::size_t>(std::max(first, 0.0));
    return {.begin = static_cast<double>(below) < first ? below + 1 : below,
            .end = static_cast<std::size_t>(std::min(last, cells - 1)) + 1};
  }

  void put(std::size_t row, std::size_t column, const Corner& a, const Corner& b,
           const Corner& c) const noexcept {
    const double x_m = cell_middle_m(size_m_, cells_, column);
    const double y_m = cell_middle_m(size_m_, cells_, row);
    const double of_a = area_m2(x_m, y_m, b, c);
    const double of_b = area_m2(x_m, y_m, c, a);
    const double of_c = area_m2(x_m, y_m, a, b);
    const bool inside = (of_a >= 0 && of_b >= 0 && of_c >= 0) || (of_a <= 0 && of_b <= 0 && of_c <= 0);
    const double whole = of_a + of_b + of_c;
    if (!inside || whole == 0) return;
    const double height_m = (of_a * a[2] + of_b * b[2] + of_c * c[2]) / whole;
    raise(heights_m_[row * cells_ + column], static_cast<float>(height_m));
  }

  double size_m_;
  std::size_t cells_;
  double per_m_;   ///< cells
  double origin_;  ///< number of the cell whose middle is the origin
  std::span<float> heights_m_;
};

Corner in_world(const std::array<float, 3>& point_m) noexcept {
  return {static_cast<double>(point_m[0]), static_cast<double>(point_m[1]), static_cast<double>(point_m[2])};
}

Corner in_world(const Transform<double>& m, const std::array<float, 3>& point_m) noexcept {
  const auto [x, y, z] = in_world(point_m);
  return {m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
          m[8] * x + m[9] * y + m[10] * z + m[11]};
}

void add_surface(const BakedMesh& mesh, const Raster& raster) {
  constexpr std::size_t kGrain = 1U << 14;
  parallel_for(mesh.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (const auto& [a, b, c] : mesh.triangles.subspan(begin, end - begin))
      raster.add(in_world(mesh.points_m[a]), in_world(mesh.points_m[b]), in_world(mesh.points_m[c]));
  });
}

void add_plant(const BakedMesh& mesh, const Transform<double>& to_world, const Raster& raster,
               std::vector<Corner>& corners_m) {
  corners_m.clear();
  for (const auto& point_m : mesh.points_m) corners_m.push_back(in_world(to_world, point_m));
  for (const auto& [a, b, c] : mesh.triangles) raster.add(corners_m[a], corners_m[b], corners_m[c]);
}

void add_plants(const BakedScene& scene, const BakedPlants& plants, const Raster& raster) {
  constexpr std::size_t kGrain = 64;
  parallel_for(plants.mesh.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Corner> corners_m;
    for (std::size_t k = begin; k < end; ++k)
      add_plant(scene.meshes[plants.mesh[k]], plants.transform[k], raster, corners_m);
  });
}

}  // namespace

TopHeights top_heights(const BakedScene& scene, double size_m, std::size_t cells) {
  TopHeights tops = {.ground_m = std::vector(cells * cells, kNone),
                     .plants_m = std::vector(cells * cells, kNone)};
  const Raster ground(size_m, cells, tops.ground_m);
  for (const BakedSurface& surface : scene.surfaces) add_surface(scene.meshes[surface.mesh], ground);
  const Raster above(size_m, cells, tops.plants_m);
  for (const BakedPlants& plants : scene.plants) add_plants(scene, plants, above);
  return tops;
}

}  // namespace thermal
