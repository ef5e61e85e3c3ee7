#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// Red, green, blue.
using PaletteColour = std::array<std::uint8_t, 3>;

/// The colour of each level, the coldest first.
using PaletteTable = std::array<PaletteColour, 256>;

/// Names for palette_table(), in the order of the help.
[[nodiscard]] const std::vector<std::string>& palette_names();

/// white_hot, black_hot: grey. ironbow: black, violet, orange, white; lightness rises with temperature. rainbow: the
/// hues from violet to red at full saturation. inferno, viridis, turbo: OpenCV's tables of those names; the first two
/// are perceptually uniform.
/// `name`: one of palette_names(). ConfigError "--palette = …" otherwise.
[[nodiscard]] PaletteTable palette_table(const std::string& name);

/// The colour of boxes and tracks of a category, by its id: light, to be shown on black. Ids below 1, and texts, have
/// the colour of 1; ids past the table wrap around.
[[nodiscard]] PaletteColour category_colour(const LabelId& id) noexcept;

}  // namespace thermal
