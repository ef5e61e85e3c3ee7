#include "dataset/run/render.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip/task.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/monitor.h"
#include "dataset/run/options.h"
#include "dataset/run/passes_folder.h"
#include "dataset/run/render_job.h"
#include "dataset/run/tracing.h"
#include "io/system/child_process.h"
#include "io/system/locks.h"

namespace thermal {
namespace {

void render_clip(const ClipSpec& clip, RenderJob& job, const std::function<bool()>& stop_wanted,
                 SpaceWatch& space, RunMonitor& monitor) {
  for (int frame = 0; frame < clip.frames; ++frame) {
    job.wait_for_frame(clip.id, frame, stop_wanted);
    space.passes_ready(job.frames_ready(clip.id));
    monitor.frame_done(clip.id);
  }
}

using Report = std::function<void(int frames)>;  ///< how many leading frames are there

/// Writes the passes of a clip that are missing, some frames at a time.
void trace_clip(const ClipSpec& clip, const ClipPasses& passes, RunMonitor& monitor, const Report& report) {
  constexpr int kFramesAtOnce = 16;
  for (int first = 0; first < clip.frames; first += kFramesAtOnce) {
    if (monitor.stop_wanted()) throw Cancelled();
    const int count = std::min(kFramesAtOnce, clip.frames - first);
    parallel_for(static_cast<std::size_t>(count), 1, [&](std::size_t begin, std::size_t end) {
      Passes planes;
      for (int frame = first + static_cast<int>(begin); frame < first + static_cast<int>(end); ++frame) {
        if (!std::filesystem::exists(passes.folder / passes_name(frame)))
          passes.source->read(frame, {}, planes);
        monitor.frame_done(clip.id);
      }
    });
    report(first + count);
  }
}

void trace_clips(const std::vector<ClipSpec>& clips, const PlanTracer& tracer, const DatasetSpec& spec,
                 const Layout& layout, RunMonitor& monitor) {
  for (const ClipSpec& clip : clips) {
    monitor.begin(clip);
    SpaceWatch space(spec, clip, layout, {.pictures = false},
                     [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
    trace_clip(clip, tracer.trace(clip, layout.passes(clip.id), true), monitor,
               [&space](int frames) { space.passes_ready(frames); });
    monitor.made(clip);
  }
}

RenderJob::Task preview_task(const ResolvedConfig& config, const GenerateOptions& options) {
  const Path folder = Layout{options.out}.preview();
  write_file_atomically(folder / "config.json", to_text(config.document));
  return {.blender = options.blender,
          .assets = options.assets,
          .plan = folder / "plan",
          .passes = folder,
          .log = folder / "blender.log",
          .clips = {},
          .threads = thread_count(options.threads),
          .supersample = 1,
          .actor_layer = false,
          .preview = true,
          .restarted = {}};
}

}  // namespace

Path find_blender(const std::string& named, const std::string& option) {
  Path found = find_program(named.empty() ? "blender" : named);
  if (!found.empty()) return found;
  if (!named.empty()) throw ConfigError(fault(option, named, "", "an executable program"));
  throw IoError(
      fmt::format("no blender on PATH; install it (apt-get install blender) or name one with {}", option));
}

RunOutcome render(const ResolvedConfig& config, const GenerateOptions& options, const RunHooks& hooks) {
  const Layout layout{options.out};
  const DatasetSpec& spec = config.spec;
  const std::vector<ClipSpec> clips = choose_clips(spec, options.clips, options.shard);
  const FolderLock lock(options.out, places_of(ids_of(clips), ids_of(spec.clips)));
  if (clips.empty()) return {};
  lock.in_turn([&] {
    check_same_passes(layout, config);
    begin_passes(layout, config, ids_of(clips));
    PlanStore(options.plan, options.assets).copy_ground_maps(layout.passes());
  });
  RunMonitor monitor(hooks, options.out, frames_of(clips));
  if (spec.engine == Engine::embree) {
    with_threads(options.threads, [&] {
      trace_clips(clips, PlanTracer({options.plan, options.assets}, spec), spec, layout, monitor);
    });
    RunOutcome outcome = monitor.outcome();
    outcome.complete = true;
    return outcome;
  }
  PlannedManifests(spec, options).write(clips);
  const ClipWork work = [&](const std::string& id, RenderJob& job, const std::function<bool()>& stop_wanted) {
    const ClipSpec& clip = spec.clip(id, "clips");
    monitor.begin(clip);
    try {
      SpaceWatch space(spec, clip, layout, {.pictures = false},
                       [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
      render_clip(clip, job, stop_wanted, space, monitor);
      monitor.made(clip);
    } catch (const ClipLost& fault) {
      monitor.lost(clip, fault.what(), fault.killed());
    }
  };
  run_workers(passes_tasks(spec, options, ids_of(clips), monitor), options.threads, work,
              [&monitor] { return monitor.stop_wanted(); });
  RunOutcome outcome = monitor.outcome();
  outcome.complete = outcome.failed.empty();
  return outcome;
}

int preview(const ResolvedConfig& config, const GenerateOptions& options, const RunHooks& hooks) {
  const FolderLock lock(options.out);
  RenderJob job(preview_task(config, options));
  const std::string clip = RenderJob::kPreview;
  Progress progress{.clip = clip, .done = 0, .total = job.wait_for_count(clip, hooks.cancelled)};
  hooks.report(progress);
  while (progress.done < progress.total) {
    job.wait_for_frame(clip, progress.done, hooks.cancelled);
    ++progress.done;
    hooks.report(progress);
  }
  job.wait_for_end(hooks.cancelled);
  return progress.total;
}

}  // namespace thermal
