#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset/run/render_job.h"

namespace thermal {

/// Distributes clips among `jobs` Blender processes, or fewer with fewer clips: the j-th gets clips j, j + jobs, …
[[nodiscard]] std::vector<std::vector<std::string>> deal_clips(const std::vector<std::string>& clips,
                                                               int jobs);

/// Number of threads for one of several Blender processes that share `threads`, at least one.
[[nodiscard]] int threads_each(int threads, int jobs);

/// Called with each clip, in the order of its task; for several tasks at the same time. `cancelled` becomes true for
/// all as soon as one throws.
using ClipWork =
    std::function<void(const std::string& clip, RenderJob& job, const std::function<bool()>& cancelled)>;

/// Renders tasks at the same time, with one Blender process and one thread each, and returns when `work` has had all
/// their clips. `work` may use `threads` threads in total (0: thread_count(0), which they share). If `work` or a job
/// throws, all stop, and the first exception is rethrown.
void run_workers(const std::vector<RenderJob::Task>& tasks, int threads, const ClipWork& work,
                 const std::function<bool()>& cancelled);

}  // namespace thermal
