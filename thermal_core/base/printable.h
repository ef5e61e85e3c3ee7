#pragma once

#include <string>
#include <string_view>

namespace thermal {

/// A text of any origin, such as a name in a file, made safe for terminals and JSON: one line of UTF-8. Line breaks
/// become "; "; other control characters and bytes that are not UTF-8 become `\x1b` and the like.
/// Source: The Unicode Standard 15.0, table 3-7 (well-formed UTF-8).
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace thermal
