#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "imaging/cut_covers.h"
#include "scene/ground_maps.h"

namespace thermal {

/// What lies on the ground of a cell besides its kind.
inline constexpr std::array<const char*, 5> kLoosePartNames = {"grass", "litter", "trodden", "ash", "rock"};

/// What a cell of the ground is made of.
struct GroundMix {
  std::uint8_t kind = 0;  ///< number among the kinds of the covers, of what the other parts leave
  std::array<std::uint8_t, kLoosePartNames.size()>
      share{};  ///< of kLoosePartNames; 255 is all, as is their sum

  [[nodiscard]] bool operator==(const GroundMix&) const = default;
};

/// Materials of all parts: the kinds of the covers, then kLoosePartNames.
[[nodiscard]] std::vector<std::string> ground_part_names(const GroundCovers& covers);

/// The cells of a window of the cut covers, [row of y, column of x]. Grass has the share of its map, and tussocks and
/// bare crowns from 6 m down to a quarter of a metre, the more the nearer the share is to a half; litter lies below crowns
/// of more than 1.5 m, less towards their rims; one place in forty is stony, as large as two cells, and in as many others
/// litter has gathered. What is trodden or burnt has no grass. Ground of other kinds has stones and what is trodden. How
/// these spread is an estimate; a cell depends on (seed, cell, cuts) alone.
/// @param rough  whether they vary from cell to cell; otherwise each share is its mean
[[nodiscard]] std::vector<GroundMix> ground_mixture(const GroundMaps& maps, const CutWindow& window,
                                                    bool rough, std::uint32_t seed);

}  // namespace thermal
