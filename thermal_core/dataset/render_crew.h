#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset/render_job.h"

namespace thermal {

/// Clips dealt out among `jobs` Blenders, or fewer where there are fewer clips: the j-th gets clips j, j + jobs, …
[[nodiscard]] std::vector<std::vector<std::string>> deal_clips(const std::vector<std::string>& clips,
                                                               int jobs);

/// Threads of one of several Blenders, of `threads` in all (0: one a core), at least one. 0 where there is only
/// one Blender and it may have every core.
[[nodiscard]] int threads_each(int threads, int cores, int jobs);

/// What is done with each clip, in the order of its task; for several tasks at the same time.
/// `cancelled` becomes true for all as soon as one throws.
using ClipWork =
    std::function<void(const std::string& clip, RenderJob& job, const std::function<bool()>& cancelled)>;

/// Renders tasks at the same time, a Blender and a thread each, and returns when `work` has had all their clips.
/// Where `work` or a job throws, all end, and the first fault is thrown on.
void run_crew(const std::vector<RenderJob::Task>& tasks, const ClipWork& work,
              const std::function<bool()>& cancelled);

}  // namespace thermal
