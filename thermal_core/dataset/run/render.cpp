#include "dataset/run/render.h"

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/run/clip_choice.h"
#include "dataset/run/disk_room.h"
#include "dataset/run/monitor.h"
#include "dataset/run/passes_folder.h"
#include "dataset/run/worker_pool.h"

namespace thermal {
namespace {

void render_clip(const ClipConfig& clip, RenderJob& job, const std::function<bool()>& stop_wanted,
                 RoomWatch& room, RunMonitor& monitor) {
  for (int frame = 0; frame < clip.frames; ++frame) {
    job.wait_for_frame(clip.id, frame, stop_wanted);
    room.passes_ready(job.frames_ready(clip.id));
    monitor.frame_done(clip.id);
  }
}

RenderJob::Task preview_task(const Config& config, const GenerateOptions& options) {
  const Path folder = Layout{options.out}.preview();
  write_file_atomically(folder / "config.json", to_text(config.resolved));
  return {.blender = options.blender,
          .assets = options.assets,
          .plan = folder / "plan",
          .passes = folder,
          .log = folder / "blender.log",
          .clips = {},
          .threads = options.threads,
          .supersample = 1,
          .actor_layer = false,
          .preview = true,
          .restarted = {}};
}

}  // namespace

RunOutcome render(const Config& config, const GenerateOptions& options, const RunHooks& hooks) {
  const Layout layout{options.out};
  const std::vector<ClipConfig> clips = choose_clips(config, options.clips, options.shard);
  const FolderLock lock(options.out, places_of(config, clips));
  if (clips.empty()) return {};
  lock.in_turn([&] {
    check_same_passes(layout, config);
    begin_passes(layout, config, ids_of(clips));
  });
  RunMonitor monitor(hooks, options.out, frames_of(clips));
  const ClipWork work = [&](const std::string& id, RenderJob& job, const std::function<bool()>& stop_wanted) {
    const ClipConfig& clip = config.clip(id, "clips");
    monitor.begin(clip);
    try {
      RoomWatch room(config, clip, layout, false, [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
      render_clip(clip, job, stop_wanted, room, monitor);
      monitor.made(clip);
    } catch (const ClipLost& fault) {
      monitor.lost(clip, fault.what(), fault.killed());
    }
  };
  run_workers(passes_tasks(config, options, ids_of(clips), monitor), options.threads, work,
              [&monitor] { return monitor.stop_wanted(); });
  RunOutcome outcome = monitor.outcome();
  outcome.complete = outcome.failed.empty();
  return outcome;
}

int preview(const Config& config, const GenerateOptions& options, const RunHooks& hooks) {
  const FolderLock lock(options.out);
  RenderJob job(preview_task(config, options));
  const std::string clip = RenderJob::kPreview;
  job.wait_for_frame(clip, -1, hooks.cancelled);
  Progress progress{.clip = clip, .done = 0, .total = job.frames_of(clip)};
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
