#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "io/system/files.h"

namespace thermal {

/// Largest table of numbers that is read [bytes]: ten times the size of a million lines.
inline constexpr std::size_t kMostTableBytes = std::size_t{256} << 20;

/// Whole content of a regular text file, without a UTF-8 byte-order mark (Excel writes one). Line ends are unchanged.
/// IoError if it is missing, a folder, a pipe or a device, unreadable, or larger than `most_bytes`: the message names
/// file, size and limit.
[[nodiscard]] std::string read_text_file(const Path& file, std::size_t most_bytes = kMostTableBytes);

/// Calls `take` with each line of such a file, without its end, and its position: "FILE:12". Empty lines and comments,
/// which start with #, are left out.
void for_table_lines(const Path& file,
                     const std::function<void(const std::string& line, const std::string& where)>& take,
                     std::size_t most_bytes = kMostTableBytes);

}  // namespace thermal
