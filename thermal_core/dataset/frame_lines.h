#pragma once

#include <functional>

#include "io/json/file.h"
#include "io/system/files.h"

namespace thermal {

/// Calls `take` with each line of a clip's frames.jsonl. DataError with file and line if one is not JSON, or lacks a
/// value that `take` reads; IoError if the file cannot be read.
void for_frame_lines(const Path& file, const std::function<void(const Json& frame)>& take);

}  // namespace thermal
