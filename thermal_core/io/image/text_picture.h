#pragma once

#include <string>

#include "io/image/text_coverage.h"
#include "io/system/files.h"

namespace thermal {

/// Draws a line of text with FreeType, anti-aliased. The bits depend on FreeType's version. A character that is not
/// ASCII shows as "?": OpenImageIO 2.4 would draw "·" as "7".
/// @param line  its text, UTF-8
/// @param font  a TrueType or OpenType file
/// @param size_px  of the letter em, 4 to 400
/// IoError naming the font if it cannot be used.
[[nodiscard]] TextPicture draw_text(const Path& font, const std::string& line, int size_px);

}  // namespace thermal
