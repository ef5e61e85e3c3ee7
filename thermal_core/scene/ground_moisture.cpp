#include "scene/ground_moisture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/between_nodes.h"
#include "base/parallel.h"

namespace thermal {
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
