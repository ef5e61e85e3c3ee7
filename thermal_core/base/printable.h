#pragma once

#include <string>
#include <string_view>

namespace thermal {

/// A text from anywhere, such as a name in a file, as it may be shown to people and kept in JSON: one line of UTF-8.
/// Line breaks become "; ", other control characters and bytes that are no UTF-8 become \x1b and the like.
/// Source: The Unicode Standard 15.0, table 3-7 (well-formed UTF-8).
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace thermal
