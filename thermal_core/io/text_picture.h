#pragma once

#include <cstdint>
#include <string>

#include "base/image.h"
#include "io/files.h"

namespace thermal {

/// A line of text as a picture: how much of each pixel the letters cover, 0 to 255.
struct TextPicture {
  Plane<std::uint8_t> coverage;  ///< from the first letter's left edge; empty for text that shows nothing
  int baseline_px = 0;           ///< the row of `coverage` that letters stand on
};

/// Draws a line of text with FreeType, anti-aliased. The bits depend on FreeType's version. A character that is not ASCII
/// shows as "?": OpenImageIO 2.4 takes "·" for "7".
/// @param line  its text, UTF-8
/// @param font  a TrueType or OpenType file
/// @param size_px  of the letter em, 4 to 400
/// IoError naming the font if it cannot be used.
[[nodiscard]] TextPicture draw_text(const Path& font, const std::string& line, int size_px);

}  // namespace thermal
