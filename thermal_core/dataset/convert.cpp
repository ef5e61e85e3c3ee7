#include "dataset/convert.h"

#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/convert_requests.h"
#include "dataset/dataset_index.h"
#include "dataset/passes_folders.h"
#include "dataset/physics.h"
#include "io/material_files.h"

namespace thermal {
namespace {

/// A dataset that is being made.
class Dataset {
 public:
  Dataset(ConvertRequest request, const MaterialLibrary& materials, const std::vector<ClipPasses>& sources)
      : request_(std::move(request)),
        layout_{request_.out},
        lock_(layout_.root),
        index_(open_dataset(layout_, request_.config)),
        behind_(!index_.complete() || !index_.recorded) {
    std::vector<const Manifest*> manifests;
    for (const ClipPasses& source : sources) manifests.push_back(&source.manifest);
    const Config& config = request_.config;
    const Budget budget = weigh_terms(outline_of(config, materials, manifests), config.terms);
    kept_ = budget.kept;
    index_.physics = to_json(budget);
    for (const ClipPasses& source : sources) {
      if (!lacks(source)) outcome_.already_there.push_back(source.manifest.clip);
    }
  }

  [[nodiscard]] bool lacks(const ClipPasses& source) const {
    return !index_.finished.contains(source.manifest.clip);
  }

  /// From here on the folder belongs to its config.
  void begin() const {
    if (!index_.complete()) write_progress(layout_, index_);
  }

  [[nodiscard]] ClipTask task_for(const ClipPasses& source) const {
    const Config& config = request_.config;
    const ClipConfig& clip = config.clip(source.manifest.clip, source.folder.string());
    return {.variant = request_.where,
            .clip = clip,
            .seed = config.seed,
            .sensor = config.sensor,
            .distortion = config.distortion,
            .labels = config.labels,
            .physics = physics_of(config, clip, kept_),
            .layout = layout_};
  }

  void add(const ClipRecord& record) {
    index_.add(record.clip, record);
    outcome_.made.push_back(record.clip);
    outcome_.frames_made += record.frames;
    write_progress(layout_, index_);
  }

  void reject(const std::string& clip, const std::string& why) {
    index_.failed[clip] = why;
    outcome_.failed[clip] = why;
    std::filesystem::remove_all(layout_.unfinished_clip(clip));
    write_progress(layout_, index_);
  }

  ConvertOutcome end() {
    if (behind_) write_dataset(layout_, index_);
    outcome_.complete = index_.complete();
    return {.variant = request_.variant, .out = request_.out, .run = outcome_};
  }

  void end_after_fault() const noexcept {
    if (behind_) write_dataset_after_fault(layout_, index_);
  }

 private:
  ConvertRequest request_;
  Layout layout_;
  FolderLock lock_;
  DatasetIndex index_;
  Terms kept_;
  bool behind_;  ///< clips are missing, or the files do not tell of all
  RunOutcome outcome_;
};

/// Makes the clips that are not there yet, clip by clip for all the datasets that lack it.
class Converter {
 public:
  Converter(const std::vector<ConvertRequest>& requests, const std::vector<ClipPasses>& sources,
            const MaterialLibrary& materials, const RunHooks& hooks)
      : sources_(sources), materials_(materials), hooks_(hooks) {
    for (const ConvertRequest& request : requests)
      datasets_.push_back(std::make_unique<Dataset>(request, materials, sources));
  }

  std::vector<ConvertOutcome> run() {
    try {
      make_all();
    } catch (...) {
      for (const auto& dataset : datasets_) dataset->end_after_fault();
      throw;
    }
    std::vector<ConvertOutcome> outcomes;
    for (const auto& dataset : datasets_) outcomes.push_back(dataset->end());
    return outcomes;
  }

 private:
  void make_all() {
    for (const auto& dataset : datasets_) dataset->begin();
    for (const ClipPasses& source : sources_) {
      if (!lacking(source).empty()) progress_.frames_total += static_cast<int>(source.manifest.frames.size());
    }
    for (const ClipPasses& source : sources_) {
      if (const std::vector<Dataset*> wanted = lacking(source); !wanted.empty()) try_make(source, wanted);
    }
  }

  [[nodiscard]] std::vector<Dataset*> lacking(const ClipPasses& source) const {
    std::vector<Dataset*> found;
    for (const auto& dataset : datasets_) {
      if (dataset->lacks(source)) found.push_back(dataset.get());
    }
    return found;
  }

  void try_make(const ClipPasses& source, const std::vector<Dataset*>& wanted) {
    progress_.clip = source.manifest.clip;
    hooks_.report(progress_);
    const int before = progress_.frames_done;
    std::vector<ClipRecord> records;
    std::string fault;
    try {
      records = make(source, wanted);
    } catch (const DataError& error) {
      fault = error.what();
    } catch (const IoError& error) {
      fault = error.what();
    }
    for (std::size_t i = 0; i < records.size(); ++i) wanted[i]->add(records[i]);
    if (fault.empty()) return;
    for (Dataset* dataset : wanted) dataset->reject(source.manifest.clip, fault);
    progress_.frames_done = before + static_cast<int>(source.manifest.frames.size());
  }

  std::vector<ClipRecord> make(const ClipPasses& source, const std::vector<Dataset*>& wanted) {
    std::vector<ClipTask> tasks;
    for (const Dataset* dataset : wanted) tasks.push_back(dataset->task_for(source));
    const ClipHooks hooks = {.wait_for_frame = {},
                             .frame_done =
                                 [this] {
                                   ++progress_.frames_done;
                                   hooks_.report(progress_);
                                 },
                             .cancelled = hooks_.cancelled};
    return make_clips(source, tasks, materials_, hooks);
  }

  const std::vector<ClipPasses>& sources_;
  const MaterialLibrary& materials_;
  const RunHooks& hooks_;
  std::vector<std::unique_ptr<Dataset>> datasets_;
  Progress progress_;
};

}  // namespace

std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks) {
  const ThreadLimit limit(options.threads);
  const MaterialLibrary materials = read_materials(options.home);
  const std::vector<ClipPasses> sources =
      find_passes(options.passes, options.manifest, materials, options.home);
  return Converter(convert_requests(options, sources), sources, materials, hooks).run();
}

}  // namespace thermal
