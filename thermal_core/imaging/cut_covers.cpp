#include "imaging/cut_covers.h"

#include <algorithm>
#include <cmath>

#include "base/spline_weights.h"

namespace thermal {
namespace {

constexpr std::size_t kMostCuts = 4;
constexpr std::size_t kMostCells = std::size_t{1} << 21U;

/// Range of the covers' cells that contain some cells of the maps, along an axis: first and count.
std::array<std::size_t, 2> covers_along(const GroundMaps& maps, std::size_t first, std::size_t count) {
  const double fine = static_cast<double>(maps.covers.cells) / static_cast<double>(maps.cells);
  const auto begin = static_cast<std::size_t>(std::floor(static_cast<double>(first) * fine));
  const auto end = static_cast<std::size_t>(std::ceil(static_cast<double>(first + count) * fine));
  return {begin, std::min(end, maps.covers.cells) - begin};
}

}  // namespace

CutWindow cut_window(const GroundMaps& maps, const GroundWindow& window) {
  const auto [first_x, width] = covers_along(maps, window.first_x, window.width);
  const auto [first_y, height] = covers_along(maps, window.first_y, window.height);
  std::size_t cuts = kMostCuts;
  while (cuts > 1 && cuts * cuts * width * height > kMostCells) cuts /= 2;
  return {.cells = {.first_x = cuts * first_x,
                    .first_y = cuts * first_y,
                    .width = cuts * width,
                    .height = cuts * height},
          .cuts = cuts};
}

CutCovers::CutCovers(const GroundCovers& covers, const CutWindow& window)
    : covers_(covers),
      rows_(near_cells(window.cells.first_y, window.cells.height, window.cuts, covers.cells)),
      columns_(near_cells(window.cells.first_x, window.cells.width, window.cuts, covers.cells)) {}

std::vector<CutCovers::Near> CutCovers::near_cells(std::size_t first, std::size_t count, std::size_t cuts,
                                                   std::size_t cells) {
  std::vector<Near> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(first + i) + 0.5) / static_cast<double>(cuts) - 0.5;
    const double low = std::floor(at);
    all[i].weight = spline_weights(at - low);
    for (std::size_t k = 0; k < 4; ++k) {
      const double cell = low + static_cast<double>(k) - 1;
      all[i].cell[k] = static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
    }
  }
  return all;
}

Cover CutCovers::at(std::size_t row, std::size_t column) const noexcept {
  const Near& rows = rows_[row];
  const Near& columns = columns_[column];
  Cover cover = {.kind = kind_at(rows, columns)};
  float whole = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t cell = rows.cell[j] * covers_.cells + columns.cell[i];
      if (covers_.kind[cell] != cover.kind) continue;
      const float weight = rows.weight[j] * columns.weight[i];
      whole += weight;
      cover.grass += weight * static_cast<float>(covers_.grass[cell]);
      cover.trodden += weight * static_cast<float>(covers_.trodden[cell]);
      cover.ash += weight * static_cast<float>(covers_.ash[cell]);
    }
  }
  constexpr float kAll = 255;
  for (float* share : {&cover.grass, &cover.trodden, &cover.ash}) *share /= kAll * whole;
  return cover;
}

std::uint8_t CutCovers::kind_at(const Near& rows, const Near& columns) const noexcept {
  const std::uint8_t middle = covers_.kind[rows.cell[1] * covers_.cells + columns.cell[1]];
  bool others = false;
  for (const std::size_t row : rows.cell)
    for (const std::size_t column : columns.cell)
      others |= covers_.kind[row * covers_.cells + column] != middle;
  if (!others) return middle;
  std::array<float, 256> share{};
  const auto each = [&](auto&& visit) {
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i)
        visit(rows.cell[j] * covers_.cells + columns.cell[i], rows.weight[j] * columns.weight[i]);
  };
  each([&](std::size_t cell, float weight) {
    share[covers_.kind[cell]] += weight * static_cast<float>(covers_.border[cell]);
  });
  std::uint8_t largest = middle;
  each([&](std::size_t cell, float) {
    const std::uint8_t kind = covers_.kind[cell];
    if (share[kind] > share[largest]) largest = kind;
  });
  return largest;
}

}  // namespace thermal
