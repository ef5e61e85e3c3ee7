#pragma once

#include <string>
#include <vector>

#include "dataset/generate.h"
#include "dataset/render_job.h"
#include "dataset/run_board.h"

namespace thermal {

/// Makes ready for the passes of clips that a run holds: a folder each, without passes that were of no use before,
/// and the resolved config beside them. A clip's folder tells other runs that somebody is at work in there.
void begin_passes(const Layout& layout, const Config& config, const std::vector<std::string>& clips);

/// Removes the passes of these clips, and with the last clip's all that lies beside them.
void end_passes(const Layout& layout, const std::vector<std::string>& clips);

/// What Blenders are to render of these clips, a task each. They tell the board when they are started again.
[[nodiscard]] std::vector<RenderJob::Task> passes_tasks(const GenerateOptions& options, const Layout& layout,
                                                        const std::vector<std::string>& clips,
                                                        RunBoard& board);

}  // namespace thermal
