#include "dataset/run/generate.h"

#include <mutex>
#include <set>
#include <system_error>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip/maker.h"
#include "dataset/dataset_index.h"
#include "dataset/passes/outline.h"
#include "dataset/run/clip_choice.h"
#include "dataset/run/disk_room.h"
#include "dataset/run/monitor.h"
#include "dataset/run/passes_folder.h"
#include "dataset/run/worker_pool.h"
#include "io/config/materials.h"
#include "io/manifest_file.h"

namespace thermal {
namespace {

using Stop = std::function<bool()>;

/// Makes clips from the output of render jobs.
class Generator {
 public:
  Generator(const Config& config, const DatasetPlan& plan, const GenerateOptions& options,
            const RunHooks& hooks)
      : config_(config),
        options_(options),
        hooks_(hooks),
        layout_{options.out},
        chosen_(choose_clips(config, options.clips, options.shard)),
        lock_(options.out, places_of(config, chosen_)),
        materials_(read_materials(options.home)),
        budget_(weigh_terms(outline_of(config, plan, materials_), config.terms)) {}

  RunOutcome run() {
    lock_.in_turn([this] {
      begin();
      if (pending_.empty()) end();
    });
    if (pending_.empty()) return outcome_of({});
    RunMonitor monitor(hooks_, options_.out, frames_of(pending_));
    try {
      make_pending(monitor);
    } catch (...) {
      end_after_fault();
      throw;
    }
    lock_.in_turn([this] {
      catch_up(layout_, own_, index_);
      index_.recorded = false;
      end();
    });
    return outcome_of(monitor.outcome());
  }

 private:
  void begin() {
    index_ = open_dataset(layout_, config_);
    index_.physics = to_json(budget_);
    for (const ClipConfig& clip : chosen_) {
      own_.insert(clip.id);
      const bool there = index_.finished.contains(clip.id);
      there ? already_there_.push_back(clip.id) : pending_.push_back(clip);
      index_.failed.erase(clip.id);
    }
    if (pending_.empty()) return;
    write_progress(layout_, index_);  // from here on the folder belongs to this config
    begin_passes(layout_, config_, ids_of(pending_));
  }

  void make_pending(RunMonitor& monitor) {
    const ClipWork work = [this, &monitor](const std::string& id, RenderJob& job, const Stop& stop_wanted) {
      try_make(config_.clip(id, "clips"), job, stop_wanted, monitor);
    };
    run_workers(passes_tasks(config_, options_, ids_of(pending_), monitor), work,
                [&monitor] { return monitor.stop_wanted(); });
  }

  void try_make(const ClipConfig& clip, RenderJob& job, const Stop& stop_wanted, RunMonitor& monitor) {
    try {
      const ClipRecord record = make(clip, job, stop_wanted, monitor);
      if (!options_.keep_passes) std::filesystem::remove_all(layout_.passes(clip.id));
      change_index([&] { index_.add(clip.id, record); });
      monitor.made(clip);
    } catch (const ClipLost& fault) {
      lose(clip, fault.what(), fault.killed(), monitor);
    } catch (const DataError& fault) {
      reject(clip, fault.what(), monitor);
    } catch (const IoError& fault) {
      job.rethrow_fault();
      reject(clip, fault.what(), monitor);
    }
  }

  ClipRecord make(const ClipConfig& clip, RenderJob& job, const Stop& stop_wanted, RunMonitor& monitor) {
    monitor.begin(clip);
    RoomWatch room(config_, clip, layout_, true, [&](std::int64_t bytes) { monitor.needs(clip.id, bytes); });
    job.wait_for_frame(clip.id, -1, stop_wanted);
    const Path folder = layout_.passes(clip.id);
    const ClipPasses passes = {.manifest = read_manifest(folder / "manifest.json", options_.home),
                               .folder = folder};
    const ClipTask task = {.variant = "",
                           .clip = clip,
                           .seed = config_.seed,
                           .sensor = config_.sensor,
                           .distortion = config_.distortion,
                           .labels = config_.labels,
                           .physics = physics_of(config_, clip, budget_.kept),
                           .layout = layout_};
    const ClipHooks clip_hooks = {.wait_for_frame =
                                      [&](int frame) {
                                        job.wait_for_frame(clip.id, frame, stop_wanted);
                                        room.passes_ready(job.frames_ready(clip.id));
                                      },
                                  .frame_done =
                                      [&] {
                                        room.pictures_written();
                                        monitor.frame_done(clip.id);
                                      },
                                  .cancelled = stop_wanted};
    try {
      return make_clip(passes, task, materials_, clip_hooks);
    } catch (...) {
      std::error_code ignored;  // an incomplete clip is useless, and takes disk space
      std::filesystem::remove_all(layout_.unfinished_clip(clip.id), ignored);
      throw;
    }
  }

  /// Useless passes are rendered anew by the next run; until then they can be inspected.
  void reject(const ClipConfig& clip, const std::string& why, RunMonitor& monitor) {
    write_file_atomically(layout_.unusable(clip.id), why + "\n");
    lose(clip, why, false, monitor);
  }

  void lose(const ClipConfig& clip, const std::string& why, bool killed, RunMonitor& monitor) {
    change_index([&] { index_.failed[clip.id] = why; });
    monitor.lost(clip, why, killed);
  }

  /// Updates the dataset's record, including what other runs have made.
  void change_index(const std::function<void()>& change) {
    const std::lock_guard lock(mutex_);
    change();
    pace_.pass([this] {
      lock_.in_turn([this] {
        catch_up(layout_, own_, index_);
        write_progress(layout_, index_);
      });
    });
  }

  void end() {
    if (!index_.recorded) write_dataset(layout_, index_);
    if (!options_.keep_passes) end_passes(layout_, finished_of(chosen_));
  }

  void end_after_fault() noexcept {
    try {
      lock_.in_turn([this] {
        catch_up(layout_, own_, index_);
        write_dataset(layout_, index_);
      });
    } catch (const std::exception&) {  // must not hide the first; the next run detects the missing record
    }
  }

  [[nodiscard]] RunOutcome outcome_of(RunOutcome outcome) const {
    outcome.already_there = already_there_;
    outcome.complete = index_.complete();
    outcome.unusable = index_.unusable(ids_of(chosen_));
    return outcome;
  }

  [[nodiscard]] std::vector<std::string> finished_of(const std::vector<ClipConfig>& clips) const {
    std::vector<std::string> ids = ids_of(clips);
    std::erase_if(ids, [this](const std::string& id) { return !index_.finished.contains(id); });
    return ids;
  }

  const Config& config_;
  const GenerateOptions& options_;
  const RunHooks& hooks_;
  Layout layout_;
  std::vector<ClipConfig> chosen_;
  FolderLock lock_;  ///< of the chosen clips
  MaterialLibrary materials_;
  Budget budget_;
  std::mutex mutex_;
  DatasetIndex index_;
  std::set<std::string> own_;
  std::vector<ClipConfig> pending_;
  std::vector<std::string> already_there_;
  ProgressPace pace_;
};

}  // namespace

RunOutcome generate(const Config& config, const DatasetPlan& plan, const GenerateOptions& options,
                    const RunHooks& hooks) {
  const ThreadLimit limit(options.threads);
  return Generator(config, plan, options, hooks).run();
}

}  // namespace thermal
