#include "dataset/run/convert.h"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/dataset_index.h"
#include "dataset/passes/folders.h"
#include "dataset/passes/identity.h"
#include "dataset/passes/outline.h"
#include "dataset/run/convert_requests.h"
#include "io/config/materials.h"

namespace thermal {
namespace {

/// The folder of a dataset, checked for links that lead elsewhere.
Layout own_layout(const ConvertRequest& request) {
  if (!request.variant.empty()) check_is_no_link(request.out);
  Layout layout{request.out};
  check_is_no_link(layout.clips());
  return layout;
}

/// Decides which terms each dataset keeps. Passes are inspected once for all.
std::vector<Budget> budgets_of(const std::vector<ConvertRequest>& requests, const MaterialLibrary& materials,
                               const std::vector<ClipPasses>& sources) {
  const bool looks =
      std::ranges::any_of(requests, [](const auto& request) { return request.config.physical; });
  const std::vector<PassesView> views =
      looks ? view_passes(sources) : std::vector<PassesView>(sources.size());
  std::vector<Budget> budgets;
  for (const ConvertRequest& request : requests)
    budgets.push_back(
        weigh_terms(outline_of(request.config, materials, sources, views), request.config.terms));
  return budgets;
}

/// Messages about automatic terms for which the passes lack something.
std::vector<std::string> terms_left_out(const Budget& budget) {
  std::vector<std::string> left_out;
  for (const TermEffect& effect : budget.effects) {
    if (effect.choice == TermChoice::automatic && !effect.impossible.empty())
      left_out.push_back(effect.name + " (" + effect.impossible + ")");
  }
  return left_out;
}

/// Whether a run makes datasets, or only says what it would make.
enum class Intent { make, forecast };

/// A dataset being made. Its folder is created and locked for that alone.
class Dataset {
 public:
  Dataset(ConvertRequest request, const Budget& budget, const MaterialLibrary& materials,
          const std::vector<ClipPasses>& sources, Intent intent)
      : request_(std::move(request)),
        layout_(own_layout(request_)),
        lock_(intent == Intent::make ? std::make_unique<FolderLock>(layout_.root) : nullptr),
        index_(open_dataset(layout_, request_.config)),
        kept_(budget.kept),
        left_out_(terms_left_out(budget)),
        behind_(!index_.complete() || !index_.recorded) {
    index_.physics = to_json(budget);
    for (const ClipPasses& source : sources) {
      if (has_new_passes(source)) {
        changed_.insert(source.manifest.clip);
      } else if (is_to_mend(source, materials)) {
        mended_.insert(source.manifest.clip);
      }
      if (!lacks(source)) outcome_.already_there.push_back(source.manifest.clip);
    }
    behind_ = behind_ || !mended_.empty() || !changed_.empty();
  }

  [[nodiscard]] bool has_changed_passes(const std::string& clip) const { return changed_.contains(clip); }

  [[nodiscard]] bool lacks(const ClipPasses& source) const {
    const std::string& clip = source.manifest.clip;
    return !index_.finished.contains(clip) || mended_.contains(clip) || changed_.contains(clip);
  }

  [[nodiscard]] ConvertForecast forecast(const std::vector<ClipPasses>& sources) const {
    ConvertForecast forecast{
        .variant = request_.variant, .out = request_.out, .steps = {}, .left_out = left_out_};
    for (const ClipPasses& source : sources) {
      const std::string& clip = source.manifest.clip;
      const auto make =
          index_.finished.contains(clip) ? ConvertStep::Action::make_again : ConvertStep::Action::make;
      forecast.steps.push_back({.clip = clip,
                                .frames = static_cast<int>(source.manifest.frames.size()),
                                .action = lacks(source) ? make : ConvertStep::Action::keep});
    }
    return forecast;
  }

  /// From here on the folder belongs to this config.
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
            .layout = layout_,
            .made_from_sha256 = source.identity_sha256};
  }

  void add(const ClipRecord& record) {
    index_.add(record.clip, record);
    outcome_.made.push_back(record.clip);
    outcome_.frames_made += record.frames;
    pace_.pass([this] { write_progress(layout_, index_); });
  }

  void reject(const std::string& clip, const std::string& why) {
    index_.failed[clip] = printable(why);
    outcome_.failed[clip] = printable(why);
    pace_.pass([this] { write_progress(layout_, index_); });
  }

  ConvertOutcome end(const std::vector<ClipPasses>& sources) {
    if (behind_) write_dataset(layout_, index_);
    outcome_.complete = index_.complete();
    for (const ClipPasses& source : sources) {
      const std::vector<UnusableShare> shares = index_.unusable({source.manifest.clip});
      outcome_.unusable.insert(outcome_.unusable.end(), shares.begin(), shares.end());
    }
    return {.variant = request_.variant,
            .out = request_.out,
            .run = outcome_,
            .skips = skips_of(sources),
            .left_out = left_out_};
  }

  void end_after_fault() const noexcept {
    if (behind_) write_dataset_after_fault(layout_, index_);
  }

 private:
  [[nodiscard]] bool has_new_passes(const ClipPasses& source) const {
    const auto found = index_.made_from_sha256.find(source.manifest.clip);
    return found != index_.made_from_sha256.end() &&
           has_changed(source, found->second, layout_.clip(source.manifest.clip) / "clip.json");
  }

  /// Whether an existing clip can be remade with more of its frames. In strict mode, making it reports what is bad.
  [[nodiscard]] bool is_to_mend(const ClipPasses& source, const MaterialLibrary& materials) const {
    const auto found = index_.skipped.find(source.manifest.clip);
    if (found == index_.skipped.end() || found->second.empty()) return false;
    return source.bad_frames == BadFrames::fail ||
           can_be_mended(source, task_for(source), materials, found->second);
  }

  [[nodiscard]] std::vector<ClipSkips> skips_of(const std::vector<ClipPasses>& sources) const {
    std::vector<ClipSkips> skips;
    for (const ClipPasses& source : sources) {
      const auto found = index_.skipped.find(source.manifest.clip);
      if (found == index_.skipped.end() || found->second.empty()) continue;
      skips.push_back({.clip = source.manifest.clip, .folder = source.folder, .frames = found->second});
    }
    return skips;
  }

  ConvertRequest request_;
  Layout layout_;
  std::unique_ptr<FolderLock> lock_;
  DatasetIndex index_;
  Terms kept_;
  std::vector<std::string> left_out_;
  bool behind_;                    ///< clips are missing, or the files do not list all
  std::set<std::string> changed_;  ///< existing clips whose passes have changed since
  std::set<std::string> mended_;   ///< existing clips that can be made with more of their frames
  RunOutcome outcome_;
  ProgressPace pace_;
};

std::vector<std::unique_ptr<Dataset>> open_datasets(const std::vector<ConvertRequest>& requests,
                                                    const std::vector<ClipPasses>& sources,
                                                    const MaterialLibrary& materials, Intent intent) {
  // First, because a required term that is impossible is a fault, and then no folder is touched.
  const std::vector<Budget> budgets = budgets_of(requests, materials, sources);
  std::vector<std::unique_ptr<Dataset>> datasets;
  for (std::size_t i = 0; i < requests.size(); ++i)
    datasets.push_back(std::make_unique<Dataset>(requests[i], budgets[i], materials, sources, intent));
  return datasets;
}

/// Makes the missing clips, clip by clip for all the datasets that lack it.
class Converter {
 public:
  Converter(const std::vector<ConvertRequest>& requests, const std::vector<ClipPasses>& sources,
            const MaterialLibrary& materials, const RunHooks& hooks)
      : sources_(sources),
        materials_(materials),
        hooks_(hooks),
        datasets_(open_datasets(requests, sources, materials, Intent::make)) {}

  std::vector<ConvertOutcome> run() {
    try {
      make_all();
    } catch (...) {
      for (const auto& dataset : datasets_) dataset->end_after_fault();
      throw;
    }
    std::vector<ConvertOutcome> outcomes;
    for (const auto& dataset : datasets_) outcomes.push_back(dataset->end(sources_));
    return outcomes;
  }

 private:
  void make_all() {
    for (const auto& dataset : datasets_) dataset->begin();
    for (const ClipPasses& source : sources_) announce(source.manifest.clip);
    for (const ClipPasses& source : sources_) {
      if (!lacking(source).empty()) progress_.total += static_cast<int>(source.manifest.frames.size());
    }
    for (const ClipPasses& source : sources_) {
      if (const std::vector<Dataset*> wanted = lacking(source); !wanted.empty()) try_make(source, wanted);
    }
  }

  void announce(const std::string& clip) const {
    const auto changed = [&clip](const auto& dataset) { return dataset->has_changed_passes(clip); };
    if (hooks_.remade && std::ranges::any_of(datasets_, changed)) hooks_.remade(clip);
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
    const int before = progress_.done;
    std::vector<ClipRecord> records;
    try {
      records = make(source, wanted);
    } catch (const DataError& fault) {
      reject(source, wanted, fault.what());
    } catch (const IoError& fault) {
      reject(source, wanted, fault.what());
    }
    for (std::size_t i = 0; i < records.size(); ++i) wanted[i]->add(records[i]);
    if (records.empty()) progress_.done = before + static_cast<int>(source.manifest.frames.size());
  }

  /// Call in a catch block: in strict mode, rethrows.
  void reject(const ClipPasses& source, const std::vector<Dataset*>& wanted, const std::string& why) const {
    for (Dataset* dataset : wanted) dataset->reject(source.manifest.clip, why);
    if (source.bad_frames == BadFrames::fail) throw;
  }

  std::vector<ClipRecord> make(const ClipPasses& source, const std::vector<Dataset*>& wanted) {
    std::vector<ClipTask> tasks;
    for (const Dataset* dataset : wanted) tasks.push_back(dataset->task_for(source));
    const ClipHooks hooks = {.wait_for_frame = {},
                             .frame_done =
                                 [this] {
                                   ++progress_.done;
                                   hooks_.report(progress_);
                                 },
                             .cancelled = hooks_.cancelled,
                             .frame_skipped =
                                 [this, &source](const SkippedFrame& frame) {
                                   if (hooks_.skipped) hooks_.skipped(source.manifest.clip, frame);
                                 }};
    return make_clips(source, tasks, materials_, hooks);
  }

  const std::vector<ClipPasses>& sources_;
  const MaterialLibrary& materials_;
  const RunHooks& hooks_;
  std::vector<std::unique_ptr<Dataset>> datasets_;
  Progress progress_;
};

std::vector<ClipPasses> read_sources(const ConvertOptions& options, const MaterialLibrary& materials) {
  std::vector<ClipPasses> sources = find_passes(options.passes, options.manifest, materials, options.home);
  for (ClipPasses& source : sources) {
    source.limits = options.limits;
    source.bad_frames = options.strict ? BadFrames::fail : BadFrames::skip;
  }
  return sources;
}

}  // namespace

std::vector<ConvertForecast> forecast_convert(const ConvertOptions& options) {
  const ThreadLimit limit(options.threads);
  const MaterialLibrary materials = read_materials(options.home);
  const std::vector<ClipPasses> sources = read_sources(options, materials);
  std::vector<ConvertForecast> forecasts;
  for (const auto& dataset :
       open_datasets(convert_requests(options, sources), sources, materials, Intent::forecast))
    forecasts.push_back(dataset->forecast(sources));
  return forecasts;
}

std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks) {
  const ThreadLimit limit(options.threads);
  const MaterialLibrary materials = read_materials(options.home);
  const std::vector<ClipPasses> sources = read_sources(options, materials);
  return Converter(convert_requests(options, sources), sources, materials, hooks).run();
}

}  // namespace thermal
