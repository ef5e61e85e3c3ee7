#pragma once

#include <string>
#include <vector>

#include "dataset/generate.h"
#include "dataset/render_job.h"
#include "dataset/run_board.h"

namespace thermal {

/// Prepares the folders for the passes of a run's clips: one each, without unusable passes of earlier runs, and the
/// resolved config beside them. A clip's folder shows other runs that the clip is being made.
void begin_passes(const Layout& layout, const Config& config, const std::vector<std::string>& clips);

/// Removes the passes of these clips, and with the last clip's everything beside them.
void end_passes(const Layout& layout, const std::vector<std::string>& clips);

/// The render jobs for these clips, one task each. They report restarts to the board.
[[nodiscard]] std::vector<RenderJob::Task> passes_tasks(const GenerateOptions& options, const Layout& layout,
                                                        const std::vector<std::string>& clips,
                                                        RunBoard& board);

}  // namespace thermal
