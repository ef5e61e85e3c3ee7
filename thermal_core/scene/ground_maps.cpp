#include "scene/ground_maps.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/interpolation.h"
#include "base/parallel.h"

namespace thermal {

std::size_t ground_map_cells(double size_m) noexcept {
  constexpr double kMostCells = 4096;
  constexpr double kWidestCellM = 1;
  return static_cast<std::size_t>(std::clamp(std::ceil(size_m / kWidestCellM), 1.0, kMostCells));
}

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

namespace {

constexpr double kShoreM = 4;      // estimate: capillary rise and seepage wet the ground for a few metres
constexpr double kNearShoreM = 2;  // no water beyond it: distances to the shore are approximate
constexpr double kSideM = 30;      // distance at which the land beside a point is compared: an estimate
constexpr double kHollowM = 2;     // estimate
constexpr double kMostInHollows = 0.5;  // estimate

std::uint8_t as_byte(double share) noexcept {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// A value for the middle of each cell, from `at(row, column)`.
template <typename At>
std::vector<std::uint8_t> map_of(std::size_t cells, const At& at) {
  std::vector<std::uint8_t> map(cells * cells);
  parallel_for(cells, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t column = 0; column < cells; ++column)
        map[row * cells + column] = as_byte(at(row, column));
  });
  return map;
}

/// Heights or distances at nodes x nodes points.
struct Grid {
  std::span<const float> values;
  std::size_t nodes = 0;

  [[nodiscard]] double at(const BetweenNodes& row, const BetweenNodes& column) const noexcept {
    const auto along = [&](std::size_t line) {
      const auto low = static_cast<double>(values[line * nodes + column.low]);
      const auto high = static_cast<double>(values[line * nodes + column.high]);
      return low + column.share_of_high * (high - low);
    };
    const double low = along(row.low);
    return low + row.share_of_high * (along(row.high) - low);
  }
};

/// Height of the lower of two opposite sides above a point, the most of four such pairs [m]. Positions are in steps of
/// the grid; `side` is kSideM in steps.
double depth_m(const Grid& height_m, double row, double column, double side) noexcept {
  constexpr double kDiagonal = 0.70710678;
  constexpr std::array<std::array<double, 2>, 4> kWays = {
      {{0, 1}, {1, 0}, {kDiagonal, kDiagonal}, {kDiagonal, -kDiagonal}}};
  const auto at = [&](double rows, double columns) {
    return height_m.at(between_nodes(row + rows, height_m.nodes),
                       between_nodes(column + columns, height_m.nodes));
  };
  double rim_m = -std::numeric_limits<double>::infinity();
  for (const auto& [rows, columns] : kWays)
    rim_m = std::max(rim_m, std::min(at(side * rows, side * columns), at(-side * rows, -side * columns)));
  return rim_m - at(0, 0);
}

}  // namespace

std::vector<std::uint8_t> ground_moisture(const BakedGround& ground, std::size_t cells) {
  const std::size_t nodes = ground.cells + 1;
  const double steps_a_cell = static_cast<double>(ground.cells) / static_cast<double>(cells);
  const double side = kSideM * static_cast<double>(ground.cells) / ground.size_m;
  const Grid height_m = {.values = ground.height_m, .nodes = nodes};
  const Grid shore_m = {.values = ground.shore_m, .nodes = nodes};
  return map_of(cells, [&](std::size_t row_number, std::size_t column_number) {
    const double row = (static_cast<double>(row_number) + 0.5) * steps_a_cell;
    const double column = (static_cast<double>(column_number) + 0.5) * steps_a_cell;
    const double below_m = depth_m(height_m, row, column, side);
    const double in_hollow = kMostInHollows * std::clamp(below_m / kHollowM, 0.0, 1.0);
    if (ground.shore_m.empty()) return in_hollow;
    const double from_shore_m = shore_m.at(between_nodes(row, nodes), between_nodes(column, nodes));
    return std::max(in_hollow, std::exp(-std::max(0.0, from_shore_m) / kShoreM));
  });
}

std::vector<float> water_depths_m(const BakedGround& ground, std::span<const float> highest_m,
                                  std::size_t cells) {
  if (ground.shore_m.empty()) return {};
  const std::size_t nodes = ground.cells + 1;
  const double steps_a_cell = static_cast<double>(ground.cells) / static_cast<double>(cells);
  const Grid height_m = {.values = ground.height_m, .nodes = nodes};
  const Grid shore_m = {.values = ground.shore_m, .nodes = nodes};
  std::vector<float> depths_m(cells * cells);
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    const std::size_t y = i / cells;
    const std::size_t x = i % cells;
    const BetweenNodes row = between_nodes((static_cast<double>(y) + 0.5) * steps_a_cell, nodes);
    const BetweenNodes column = between_nodes((static_cast<double>(x) + 0.5) * steps_a_cell, nodes);
    if (shore_m.at(row, column) < kNearShoreM)
      depths_m[i] = std::max(0.0F, highest_m[i] - static_cast<float>(height_m.at(row, column)));
  }
  return depths_m;
}

}  // namespace thermal
