#pragma once

#include <string>
#include <vector>

#include "bench/convert_row.h"
#include "bench/convert_stages.h"

namespace thermal {

/// What `frames` frames cost from their files to a finished clip, a frame; `threads` 0: as many as there are
/// processors. What bounds it is told from `stages`, which were measured before. Writes into `folder`.
[[nodiscard]] ConvertRow convert_whole_row(const ConvertJob& job, bool physical, int frames, int threads,
                                           const std::vector<ConvertRow>& stages, const Path& folder);

}  // namespace thermal
