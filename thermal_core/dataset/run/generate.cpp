#include "dataset/run/generate.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip/maker.h"
#include "dataset/outline/outline.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/monitor.h"
#include "dataset/run/options.h"
#include "dataset/run/passes_folder.h"
#include "dataset/run/render_job.h"
#include "dataset/run/tracing.h"
#include "dataset/run/transaction.h"
#include "io/config/materials.h"

namespace thermal {
namespace {

using Stop = std::function<bool()>;

/// That this machine's FFmpeg has the codecs, each tried once.
void check_codecs(const DatasetSpec& spec) {
  std::set<std::string> tried;
  for (const ClipSpec& clip : spec.clips) {
    const std::optional<VideoCodecSettings>& codec = clip.settings->codec;
    if (codec && tried.insert(codec->name).second)
      check_video_codec(*codec, clip.frame_rate_hz, spec.width_px, spec.height_px);
  }
}

/// Makes clips from the output of render jobs.
class Generator {
 public:
  Generator(const ResolvedConfig& config, const DatasetPlan& plan, const GenerateOptions& options,
            const RunHooks& hooks)
      : config_(config),
        spec_(config.spec),
        options_(options),
        hooks_(hooks),
        layout_{options.out, options.scratch},
        store_(options.plan, options.assets),
        chosen_(choose_clips(spec_, options.clips, options.shard)),
        materials_(read_materials(options.assets)),
        heat_(materials_),
        kept_(spec_, outline_of(spec_, plan, materials_)),
        transaction_(layout_, config.document, ids_of(spec_.clips), to_json(kept_.budget()),
                     ids_of(chosen_)) {
    for (const ClipSpec& clip : chosen_)
      index().finished.contains(clip.id) ? already_there_.push_back(clip.id) : pending_.push_back(clip);
  }

  RunOutcome run() {
    RunMonitor monitor(hooks_, options_.out, frames_of(pending_));
    if (!pending_.empty()) {
      transaction_.begin([this] {
        if (options_.keep_passes || spec_.engine == Engine::blender)
          begin_passes(layout_, config_, ids_of(pending_));
        if (options_.keep_passes) store_.copy_ground_maps(layout_.passes());
      });
      make_pending(monitor);
    }
    std::vector<LeftOver> passes;
    std::vector<LeftOver> left_over = transaction_.close([&] {
      if (!options_.keep_passes) passes = end_passes(layout_, config_, finished_of(chosen_));
    });
    left_over.insert(left_over.end(), passes.begin(), passes.end());
    return outcome_of(monitor.outcome(), std::move(left_over));
  }

 private:
  void make_pending(RunMonitor& monitor) {
    if (spec_.engine == Engine::embree) {
      const PlanTracer tracer(store_, spec_);
      ground_ = store_.ground_maps(spec_, tracer.scene());
      for (const ClipSpec& clip : pending_) try_make(clip, tracer, monitor);
      return;
    }
    const PlannedManifests manifests(spec_, options_);
    manifests.write(pending_);
    ground_ = store_.ground_maps(spec_, manifests.scene());
    const ClipWork work = [&](const std::string& id, RenderJob& job, const Stop& stop_wanted) {
      try_make(spec_.clip(id, "clips"), manifests, job, stop_wanted, monitor);
    };
    run_workers(passes_tasks(spec_, options_, ids_of(pending_), monitor), options_.threads, work,
                [&monitor] { return monitor.stop_wanted(); });
  }

  void try_make(const ClipSpec& clip, const PlanTracer& tracer, RunMonitor& monitor) {
    try {
      commit(clip, make(clip, tracer, monitor), monitor);
    } catch (const DataError& fault) {
      fail_clip(clip, fault.what(), false, monitor);
    } catch (const IoError& fault) {
      fail_clip(clip, fault.what(), false, monitor);
    }
  }

  void try_make(const ClipSpec& clip, const PlannedManifests& manifests, RenderJob& job,
                const Stop& stop_wanted, RunMonitor& monitor) {
    try {
      commit(clip, make(clip, manifests, job, stop_wanted, monitor), monitor);
    } catch (const ClipLost& fault) {
      fail_clip(clip, fault.what(), fault.killed(), monitor);
    } catch (const DataError& fault) {
      reject(clip, fault.what(), monitor);
    } catch (const IoError& fault) {
      job.rethrow_fault();
      reject(clip, fault.what(), monitor);
    }
  }

  void commit(const ClipSpec& clip, const ClipRecord& record, RunMonitor& monitor) {
    transaction_.commit(record);
    if (!options_.keep_passes && spec_.engine == Engine::blender)
      (void)sweep_folder(layout_.passes(clip.id));  // or end_passes() says why not
    monitor.made(clip);
  }

  ClipRecord make(const ClipSpec& clip, const PlanTracer& tracer, RunMonitor& monitor) {
    monitor.begin(clip);
    const bool keep = options_.keep_passes;
    SpaceWatch space(spec_, clip, layout_, {.passes = keep},
                     [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
    int done = 0;
    const ClipHooks clip_hooks = {.wait_for_frame = {},
                                  .frame_done =
                                      [&] {
                                        if (keep) space.passes_ready(++done);
                                        space.pictures_written();
                                        monitor.frame_done(clip.id);
                                      },
                                  .cancelled = [&monitor] { return monitor.stop_wanted(); }};
    return make_clip(tracer.trace(clip, layout_.passes(clip.id), keep), task_for(clip), materials_,
                     clip_hooks);
  }

  ClipRecord make(const ClipSpec& clip, const PlannedManifests& manifests, RenderJob& job,
                  const Stop& stop_wanted, RunMonitor& monitor) {
    monitor.begin(clip);
    SpaceWatch space(spec_, clip, layout_, {}, [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
    const ClipPasses passes = {.manifest = manifests.of(clip), .folder = layout_.passes(clip.id)};
    const ClipHooks clip_hooks = {.wait_for_frame =
                                      [&](int frame) {
                                        job.wait_for_frame(clip.id, frame, stop_wanted);
                                        space.passes_ready(job.frames_ready(clip.id));
                                      },
                                  .frame_done =
                                      [&] {
                                        space.pictures_written();
                                        monitor.frame_done(clip.id);
                                      },
                                  .cancelled = stop_wanted};
    return make_clip(passes, task_for(clip), materials_, clip_hooks);
  }

  [[nodiscard]] ClipTask task_for(const ClipSpec& clip) {
    ClipTask task = task_of(spec_, clip, kept_.of(clip), heat_, ground_);
    task.folder = transaction_.unfinished(clip.id);
    return task;
  }

  /// Useless passes are rendered anew by the next run; until then they can be inspected.
  void reject(const ClipSpec& clip, const std::string& why, RunMonitor& monitor) {
    write_file_atomically(layout_.unusable(clip.id), why + "\n");
    fail_clip(clip, why, false, monitor);
  }

  void fail_clip(const ClipSpec& clip, const std::string& why, bool killed, RunMonitor& monitor) {
    transaction_.reject(clip.id, why);
    monitor.lost(clip, why, killed);
  }

  [[nodiscard]] RunOutcome outcome_of(RunOutcome outcome, std::vector<LeftOver> left_over) const {
    outcome.already_there = already_there_;
    outcome.left_over = std::move(left_over);
    outcome.complete = index().complete();
    outcome.unusable = index().unusable(ids_of(chosen_));
    return outcome;
  }

  [[nodiscard]] std::vector<std::string> finished_of(const std::vector<ClipSpec>& clips) const {
    std::vector<std::string> ids = ids_of(clips);
    std::erase_if(ids, [this](const std::string& id) { return !index().finished.contains(id); });
    return ids;
  }

  [[nodiscard]] const DatasetIndex& index() const { return transaction_.index(); }

  const ResolvedConfig& config_;
  const DatasetSpec& spec_;
  const GenerateOptions& options_;
  const RunHooks& hooks_;
  Layout layout_;
  PlanStore store_;
  std::vector<ClipSpec> chosen_;
  MaterialLibrary materials_;
  HeatDays heat_;
  std::shared_ptr<const GroundMaps> ground_;  ///< null: not needed
  KeptTerms kept_;
  DatasetTransaction transaction_;  ///< of the chosen clips
  std::vector<ClipSpec> pending_;
  std::vector<std::string> already_there_;
};

}  // namespace

RunOutcome generate(const ResolvedConfig& config, const DatasetPlan& plan, const GenerateOptions& options,
                    const RunHooks& hooks) {
  check_codecs(config.spec);
  return with_threads(options.threads, [&] { return Generator(config, plan, options, hooks).run(); });
}

}  // namespace thermal
