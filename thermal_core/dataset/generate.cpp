#include "dataset/generate.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip_maker.h"
#include "dataset/dataset_index.h"
#include "dataset/physics.h"
#include "dataset/render_job.h"
#include "io/manifest_file.h"
#include "io/material_files.h"

namespace thermal {
namespace {

std::vector<std::string> ids_of(const std::vector<ClipConfig>& clips) {
  std::vector<std::string> ids;
  for (const ClipConfig& clip : clips) ids.push_back(clip.id);
  return ids;
}

int frames_of(const std::vector<ClipConfig>& clips) {
  int frames = 0;
  for (const ClipConfig& clip : clips) frames += clip.frames;
  return frames;
}

/// What Blender shall render into a folder. The resolved config lies there too, beside what it explains.
RenderJob::Task render_task(const Config& config, const GenerateOptions& options, const Path& folder) {
  make_folder(folder);
  const Path resolved = folder / "config.json";
  write_file_atomically(resolved, to_text(config.resolved));
  return {.blender = options.blender,
          .home = options.home,
          .config = resolved,
          .passes = folder,
          .log = folder / "blender.log",
          .clips = {},
          .threads = options.threads};
}

RenderJob::Task passes_task(const Config& config, const GenerateOptions& options, const Layout& layout,
                            const std::vector<ClipConfig>& clips) {
  RenderJob::Task task = render_task(config, options, layout.passes());
  task.clips = ids_of(clips);
  return task;
}

RenderJob::Task preview_task(const Config& config, const GenerateOptions& options, const Layout& layout) {
  RenderJob::Task task = render_task(config, options, layout.preview());
  task.preview = true;
  return task;
}

/// Makes clips one after another from what a render job delivers.
class Generator {
 public:
  Generator(const Config& config, const GenerateOptions& options, const RunHooks& hooks)
      : config_(config),
        options_(options),
        hooks_(hooks),
        layout_{options.out},
        materials_(read_materials(options.home)),
        index_(open_dataset(layout_, config)) {
    index_.budget = weigh_terms(outline_of(config, materials_, options.home), config.terms);
  }

  RunOutcome run() {
    for (const ClipConfig& clip : choose_clips(config_, options_.clips, options_.shard)) {
      index_.finished.contains(clip.id) ? outcome_.already_there.push_back(clip.id)
                                        : pending_.push_back(clip);
    }
    try {
      if (!pending_.empty()) make_pending();
    } catch (...) {
      write_dataset_after_fault(layout_, index_);
      throw;
    }
    if (!pending_.empty() || !index_.recorded) write_dataset(layout_, index_);
    if (!options_.keep_passes) std::filesystem::remove_all(layout_.passes());
    outcome_.complete = index_.complete();
    return outcome_;
  }

 private:
  void make_pending() {
    write_progress(layout_, index_);  // from here on the folder belongs to this config
    progress_.frames_total = frames_of(pending_);
    RenderJob job(passes_task(config_, options_, layout_, pending_));
    for (const ClipConfig& clip : pending_) {
      make(clip, job);
      write_progress(layout_, index_);
    }
    job.wait_for_end(hooks_.cancelled);
  }

  void make(const ClipConfig& clip, RenderJob& job) {
    progress_.clip = clip.id;
    hooks_.report(progress_);
    job.wait_for_frame(clip.id, -1, hooks_.cancelled);
    const Path folder = layout_.passes(clip.id);
    const ClipPasses passes = {.manifest = read_manifest(folder / "manifest.json", options_.home),
                               .folder = folder};
    const ClipTask task = {.variant = "",
                           .clip = clip,
                           .seed = config_.seed,
                           .sensor = config_.sensor,
                           .distortion = config_.distortion,
                           .physics = physics_of(config_, clip, index_.budget.kept),
                           .layout = layout_};
    const ClipHooks clip_hooks = {
        .wait_for_frame = [&](int frame) { job.wait_for_frame(clip.id, frame, hooks_.cancelled); },
        .frame_done =
            [&] {
              ++progress_.frames_done;
              hooks_.report(progress_);
            },
        .cancelled = hooks_.cancelled};
    index_.add(clip.id, make_clip(passes, task, materials_, clip_hooks));
    outcome_.made.push_back(clip.id);
    outcome_.frames_made += clip.frames;
    if (!options_.keep_passes) std::filesystem::remove_all(folder);
  }

  const Config& config_;
  const GenerateOptions& options_;
  const RunHooks& hooks_;
  Layout layout_;
  MaterialLibrary materials_;
  DatasetIndex index_;
  std::vector<ClipConfig> pending_;
  Progress progress_;
  RunOutcome outcome_;
};

/// A folder for passes belongs to one config, like a dataset's.
void check_same_passes(const Config& config, const Layout& layout) {
  const Path there = layout.passes() / "config.json";
  if (!std::filesystem::exists(there)) return;
  const std::vector<std::string> found = differences(config.resolved, read_json(there));
  if (found.empty()) return;
  throw ConfigError(
      fmt::format("{} holds passes of another config: {}; expected the same config, or another folder",
                  layout.passes().string(), fmt::join(found, ", ")));
}

}  // namespace

std::vector<ClipConfig> choose_clips(const Config& config, const std::vector<std::string>& ids,
                                     const Shard& shard) {
  for (const std::string& id : ids) (void)config.clip(id, "--clips");
  std::vector<ClipConfig> chosen;
  for (std::size_t i = 0; i < config.clips.size(); ++i) {
    const ClipConfig& clip = config.clips[i];
    const bool named = ids.empty() || std::find(ids.begin(), ids.end(), clip.id) != ids.end();
    if (named && static_cast<int>(i) % shard.count == shard.index) chosen.push_back(clip);
  }
  return chosen;
}

RunOutcome generate(const Config& config, const GenerateOptions& options, const RunHooks& hooks) {
  const ThreadLimit limit(options.threads);
  const FolderLock lock(options.out);
  return Generator(config, options, hooks).run();
}

RunOutcome render(const Config& config, const GenerateOptions& options, const RunHooks& hooks) {
  const FolderLock lock(options.out);
  const Layout layout{options.out};
  check_same_passes(config, layout);
  const std::vector<ClipConfig> clips = choose_clips(config, options.clips, options.shard);
  RunOutcome outcome;
  if (clips.empty()) return outcome;
  Progress progress{.clip = "", .frames_done = 0, .frames_total = frames_of(clips)};
  RenderJob job(passes_task(config, options, layout, clips));
  for (const ClipConfig& clip : clips) {
    progress.clip = clip.id;
    hooks.report(progress);
    for (int frame = 0; frame < clip.frames; ++frame) {
      job.wait_for_frame(clip.id, frame, hooks.cancelled);
      ++progress.frames_done;
      hooks.report(progress);
    }
    outcome.made.push_back(clip.id);
    outcome.frames_made += clip.frames;
  }
  job.wait_for_end(hooks.cancelled);
  outcome.complete = true;
  return outcome;
}

int preview(const Config& config, const GenerateOptions& options, const RunHooks& hooks) {
  const FolderLock lock(options.out);
  RenderJob job(preview_task(config, options, Layout{options.out}));
  const std::string clip = RenderJob::kPreview;
  job.wait_for_frame(clip, -1, hooks.cancelled);
  Progress progress{.clip = clip, .frames_done = 0, .frames_total = job.frames_of(clip)};
  hooks.report(progress);
  while (progress.frames_done < progress.frames_total) {
    job.wait_for_frame(clip, progress.frames_done, hooks.cancelled);
    ++progress.frames_done;
    hooks.report(progress);
  }
  job.wait_for_end(hooks.cancelled);
  return progress.frames_total;
}

}  // namespace thermal
