#pragma once

#include <string>
#include <vector>

#include "bench/convert_row.h"
#include "bench/convert_stages.h"

namespace thermal {

/// Cost per frame of converting `frames` frames from files to a finished clip; `threads` 0: one per processor. The
/// bottleneck is derived from `stages`, measured before. Writes into `folder`.
[[nodiscard]] ConvertRow convert_whole_row(const ConvertJob& job, bool physical, int frames, int threads,
                                           const std::vector<ConvertRow>& stages, const Path& folder);

}  // namespace thermal
