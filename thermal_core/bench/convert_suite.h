#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/convert_stages.h"
#include "scene/material.h"

namespace thermal {

/// Cost per frame of converting `frames` frames from files to a finished clip; `threads` 0: one per processor. The
/// bottleneck is derived from `stages`, measured before. Writes into `folder`.
[[nodiscard]] ConvertRow convert_whole_row(const ConvertJob& job, bool physical, int frames, int threads,
                                           const std::vector<ConvertRow>& stages, const Path& folder);

/// The converter from files of passes to frames and labels, in a temporary folder: the machine's limits, the time of
/// each stage in one thread, and the time of whole clips, at 640 x 512 and 3840 x 3072. `announce` is called with the
/// name of each measurement before it starts. IoError if the folder cannot be written.
[[nodiscard]] std::vector<ConvertRow> run_convert_suite(
    const MaterialLibrary& materials, const std::function<void(const std::string&)>& announce);

}  // namespace thermal
