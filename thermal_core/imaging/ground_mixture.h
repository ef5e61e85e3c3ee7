#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "imaging/cut_covers.h"
#include "scene/ground_maps.h"

namespace thermal {

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
