#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "imaging/ground/noise.h"
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

/// Materials on the ground of a cell besides its kind.
inline constexpr std::array<const char*, 5> kLoosePartNames = {"grass", "litter", "trodden", "ash", "rock"};

/// Composition of a cell of the ground.
struct GroundMix {
  std::uint8_t kind = 0;  ///< index among the kinds of the covers, with the share that the other parts leave
  std::array<std::uint8_t, kLoosePartNames.size()>
      share{};  ///< of kLoosePartNames; 255 is all, as is their sum

  [[nodiscard]] bool operator==(const GroundMix&) const = default;
};

/// Materials of all parts: the kinds of the covers, then kLoosePartNames.
[[nodiscard]] std::vector<std::string> ground_part_names(const GroundCovers& covers);

/// The cells of a window of the cut covers, [row of y, column of x]. Grass has the share of its map, and tussocks and
/// bare crowns from 6 m down to a quarter of a metre, the more the nearer the share is to a half; litter lies below
/// crowns of more than 1.5 m, less towards their rims; one point in forty is in a stony spot, two cells wide, and as
/// many are in accumulated litter. Trodden or burnt ground has no grass. Other kinds of ground have stones and trodden
/// parts. These distributions are estimates; a cell depends on (seed, cell, cuts) alone.
/// @param rough  whether they vary from cell to cell; otherwise each share is its mean
[[nodiscard]] std::vector<GroundMix> ground_mixture(const GroundMaps& maps, const CutWindow& window,
                                                    bool rough, std::uint32_t seed);

}  // namespace thermal
