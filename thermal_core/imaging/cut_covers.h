#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "imaging/ground_window.h"
#include "scene/ground_maps.h"

namespace thermal {

/// A window of the covers, subdivided into cuts x cuts per cell; counts are of subdivided cells.
struct CutWindow {
  GroundWindow cells;
  std::size_t cuts = 1;

  [[nodiscard]] bool operator==(const CutWindow&) const = default;
};

/// The covers of a window that contains the given cells of the maps, subdivided by 4 x 4 if that stays below two
/// million cells, otherwise by 2 x 2 or not at all: covers of half a metre become 12 cm.
[[nodiscard]] CutWindow cut_window(const GroundMaps& maps, const GroundWindow& window);

/// Cover of a point: a kind, and shares of what lies on it.
struct Cover {
  std::uint8_t kind = 0;
  float grass = 0;
  float trodden = 0;
  float ash = 0;
};

/// Covers interpolated between the middles of their cells, by cubic B-splines over 4 x 4 cells. Kinds meet in lines: a
/// point has the kind with the largest weight times distance to its border, which preserves straight borders. Without
/// these distances, the steps of the cells are only rounded, and borders are off by up to half a cell. Shares are
/// averaged over cells of that kind alone, so they do not fade at its border.
class CutCovers {
 public:
  CutCovers(const GroundCovers& covers, const CutWindow& window);

  /// @param row, column  of the window
  [[nodiscard]] Cover at(std::size_t row, std::size_t column) const noexcept;

 private:
  /// Four rows or columns of the covers, and their weights.
  struct Near {
    std::array<std::size_t, 4> cell{};
    std::array<float, 4> weight{};
  };

  [[nodiscard]] static std::vector<Near> near_cells(std::size_t first, std::size_t count, std::size_t cuts,
                                                    std::size_t cells);
  [[nodiscard]] std::uint8_t kind_at(const Near& rows, const Near& columns) const noexcept;

  const GroundCovers& covers_;
  std::vector<Near> rows_;
  std::vector<Near> columns_;
};

}  // namespace thermal
