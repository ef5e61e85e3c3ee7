#include "scene/ground_moisture.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.h"

namespace thermal {
namespace {

constexpr double kShoreM = 4;       // estimate: capillary rise and seepage wet the ground for a few metres
constexpr double kSurroundsM = 40;  // standard deviation; of the planner's own low and high land
constexpr double kHollowM = 2;      // estimate
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

/// Where a number of nodes along a side is interpolated.
struct Between {
  std::size_t low = 0;
  std::size_t high = 0;
  double share_of_high = 0;
};

/// @param place  in steps from the first node; clamped to the nodes
Between between(double place, std::size_t nodes) noexcept {
  const auto last = static_cast<double>(nodes - 1);
  const double inside = std::clamp(place, 0.0, last);
  const double low = std::min(std::floor(inside), std::max(last - 1, 0.0));
  const auto number = static_cast<std::size_t>(low);
  return {.low = number, .high = std::min(number + 1, nodes - 1), .share_of_high = inside - low};
}

/// Values on nodes x nodes places.
template <typename Value>
struct Grid {
  std::span<const Value> values;
  std::size_t nodes = 0;

  [[nodiscard]] double at(const Between& row, const Between& column) const noexcept {
    const auto along = [&](std::size_t line) {
      const auto low = static_cast<double>(values[line * nodes + column.low]);
      const auto high = static_cast<double>(values[line * nodes + column.high]);
      return low + column.share_of_high * (high - low);
    };
    const double low = along(row.low);
    return low + row.share_of_high * (along(row.high) - low);
  }
};

/// Means of the 2 `reach` + 1 values around each; beyond the ends, the last ones repeat.
void box_mean(std::span<const double> values, std::size_t reach, std::span<double> out) {
  const auto at = [&](std::ptrdiff_t k) {
    return values[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(k, 0, static_cast<std::ptrdiff_t>(values.size()) - 1))];
  };
  const auto far = static_cast<std::ptrdiff_t>(reach);
  double sum = 0;
  for (std::ptrdiff_t k = -far; k <= far; ++k) sum += at(k);
  for (std::size_t k = 0; k < values.size(); ++k) {
    out[k] = sum / static_cast<double>(2 * reach + 1);
    const auto here = static_cast<std::ptrdiff_t>(k);
    sum += at(here + far + 1) - at(here - far);
  }
}

/// Means of rows, transposed: twice is of both directions.
std::vector<double> smoothed_rows(const std::vector<double>& grid, std::size_t nodes, std::size_t reach) {
  std::vector<double> turned(grid.size());
  parallel_for(nodes, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<double> one(nodes);
    std::vector<double> other(nodes);
    for (std::size_t row = begin; row < end; ++row) {
      std::copy_n(grid.begin() + static_cast<std::ptrdiff_t>(row * nodes), nodes, one.begin());
      for (int pass = 0; pass < 3; ++pass) {
        box_mean(one, reach, other);
        std::swap(one, other);
      }
      for (std::size_t k = 0; k < nodes; ++k) turned[k * nodes + row] = one[k];
    }
  });
  return turned;
}

/// Three boxes in a row are nearly a Gaussian: their variances add up, ((2 r + 1)^2 - 1) / 12 each.
std::size_t reach_of(double deviation) noexcept {
  return static_cast<std::size_t>(
      std::max(1.0, std::round((std::sqrt(4 * deviation * deviation + 1) - 1) / 2)));
}

}  // namespace

std::vector<std::uint8_t> ground_moisture(const BakedGround& ground, std::size_t cells) {
  const std::size_t nodes = ground.cells + 1;
  const double nodes_a_cell = static_cast<double>(ground.cells) / static_cast<double>(cells);
  const std::size_t reach =
      std::min(reach_of(kSurroundsM * static_cast<double>(ground.cells) / ground.size_m), nodes);
  const std::vector<double> heights(ground.height_m.begin(), ground.height_m.end());
  const std::vector<double> means = smoothed_rows(smoothed_rows(heights, nodes, reach), nodes, reach);
  const Grid<float> height_m = {.values = ground.height_m, .nodes = nodes};
  const Grid<double> mean_m = {.values = means, .nodes = nodes};
  const Grid<float> shore_m = {.values = ground.shore_m, .nodes = nodes};
  return map_of(cells, [&](std::size_t row_number, std::size_t column_number) {
    const Between row = between((static_cast<double>(row_number) + 0.5) * nodes_a_cell, nodes);
    const Between column = between((static_cast<double>(column_number) + 0.5) * nodes_a_cell, nodes);
    const double below_m = mean_m.at(row, column) - height_m.at(row, column);
    const double in_hollow = kMostInHollows * std::clamp(below_m / kHollowM, 0.0, 1.0);
    if (ground.shore_m.empty()) return in_hollow;
    return std::max(in_hollow, std::exp(-std::max(0.0, shore_m.at(row, column)) / kShoreM));
  });
}

std::vector<std::uint8_t> cover_share(const BakedGround& ground, std::string_view cover, std::size_t cells) {
  const auto found = std::ranges::find(ground.covers, cover);
  if (found == ground.covers.end()) return std::vector<std::uint8_t>(cells * cells);
  const std::size_t nodes = ground.cells;
  const auto number = static_cast<std::size_t>(found - ground.covers.begin());
  const Grid<std::uint8_t> share = {.values = ground.cover.subspan(number * nodes * nodes, nodes * nodes),
                                    .nodes = nodes};
  const double nodes_a_cell = static_cast<double>(nodes) / static_cast<double>(cells);
  return map_of(cells, [&](std::size_t row, std::size_t column) {
    return share.at(between((static_cast<double>(row) + 0.5) * nodes_a_cell - 0.5, nodes),
                    between((static_cast<double>(column) + 0.5) * nodes_a_cell - 0.5, nodes)) /
           255;
  });
}

}  // namespace thermal
