#include "dataset/run/convert.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/clip/pass_folders.h"
#include "dataset/dataset_index.h"
#include "dataset/outline/outline.h"
#include "dataset/run/convert_requests.h"
#include "dataset/run/transaction.h"
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

/// DataError if no frame of any clip can be converted. Looks at clips that have not been looked at.
void check_any_readable(const std::vector<ClipPasses>& sources, std::vector<PassesView>& views) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    PassesView& view = views[i];
    if (!view.planes && view.fault.empty()) view = view_passes(sources[i], false);
    if (view.planes) return;
    if (sources[i].bad_frames == BadFrames::fail) throw DataError(view.fault);
    faults.push_back(fmt::format("clip {} rejected: {}", sources[i].manifest.clip, view.fault));
  }
  throw DataError(fmt::format("{}", fmt::join(faults, "\n")));
}

/// What the clips' first readable frames have, as far as a dataset needs it: inspected once for all.
std::vector<PassesView> views_of(const std::vector<ConvertRequest>& requests,
                                 const std::vector<ClipPasses>& sources) {
  const bool looks =
      std::ranges::any_of(requests, [](const auto& request) { return request.config.spec.physical; });
  std::vector<PassesView> views;
  for (const ClipPasses& source : sources) views.push_back(looks ? view_passes(source, true) : PassesView());
  return views;
}

/// New datasets are begun only if there is something to put into one.
std::vector<PassesView> views_to_make(const std::vector<ConvertRequest>& requests,
                                      const std::vector<ClipPasses>& sources) {
  std::vector<PassesView> views = views_of(requests, sources);
  const bool is_new = std::ranges::none_of(
      requests, [](const ConvertRequest& request) { return Layout{request.out}.is_begun(); });
  if (is_new) check_any_readable(sources, views);
  return views;
}

/// Decides which terms each dataset keeps.
std::vector<KeptTerms> terms_of(const std::vector<ConvertRequest>& requests, const MaterialLibrary& materials,
                                const std::vector<ClipPasses>& sources,
                                const std::vector<PassesView>& views) {
  std::vector<KeptTerms> kept;
  for (const ConvertRequest& request : requests)
    kept.emplace_back(request.config.spec, outline_of(request.config.spec, materials, sources, views));
  return kept;
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

/// How a dataset makes a clip, but for the folder to make it in.
ClipTask task_for(const ConvertRequest& request, const KeptTerms& kept, const ClipPasses& source,
                  HeatDays& heat) {
  const DatasetSpec& spec = request.config.spec;
  const ClipSpec& clip = spec.clip(source.manifest.clip, source.folder.string());
  ClipTask task = task_of(spec, clip, kept.of(clip), heat, heat.ground_beside(source.folder));
  task.variant = request.where;
  task.made_from_sha256 = source.identity_sha256;
  return task;
}

bool has_new_passes(const DatasetIndex& index, const Layout& layout, const ClipPasses& source) {
  const auto found = index.made_from_sha256.find(source.manifest.clip);
  return found != index.made_from_sha256.end() &&
         has_changed(source, found->second, layout.clip(source.manifest.clip) / "clip.json");
}

/// Whether an existing clip can be remade with more of its frames. In strict mode, making it reports what is bad.
bool is_to_mend(const ConvertRequest& request, const DatasetIndex& index, const KeptTerms& kept,
                const ClipPasses& source, HeatDays& heat) {
  const auto found = index.skipped.find(source.manifest.clip);
  if (found == index.skipped.end() || found->second.empty()) return false;
  return source.bad_frames == BadFrames::fail ||
         can_be_mended(source, task_for(request, kept, source, heat), heat.materials(), found->second);
}

/// The clips that a dataset lacks, or has from passes that were different.
struct Backlog {
  std::set<std::string> missing;
  std::set<std::string> changed;   ///< their passes have changed since
  std::set<std::string> repaired;  ///< can be made with more of their frames

  [[nodiscard]] bool has(const std::string& clip) const {
    return missing.contains(clip) || changed.contains(clip) || repaired.contains(clip);
  }
  [[nodiscard]] bool empty() const { return missing.empty() && changed.empty() && repaired.empty(); }
};

Backlog backlog_of(const ConvertRequest& request, const DatasetIndex& index, const KeptTerms& kept,
                   const std::vector<ClipPasses>& sources, HeatDays& heat) {
  Backlog backlog;
  for (const ClipPasses& source : sources) {
    const std::string& clip = source.manifest.clip;
    if (!index.finished.contains(clip)) {
      backlog.missing.insert(clip);
    } else if (has_new_passes(index, Layout{request.out}, source)) {
      backlog.changed.insert(clip);
    } else if (is_to_mend(request, index, kept, source, heat)) {
      backlog.repaired.insert(clip);
    }
  }
  return backlog;
}

ConvertForecast forecast_of(const ConvertRequest& request, const KeptTerms& kept,
                            const std::vector<ClipPasses>& sources, HeatDays& heat) {
  const DatasetIndex index =
      open_dataset(own_layout(request), request.config.document, ids_of(request.config.spec.clips));
  const Backlog backlog = backlog_of(request, index, kept, sources, heat);
  ConvertForecast forecast{
      .variant = request.variant, .out = request.out, .steps = {}, .left_out = terms_left_out(kept.budget())};
  for (const ClipPasses& source : sources) {
    const std::string& clip = source.manifest.clip;
    const auto make =
        backlog.missing.contains(clip) ? ConvertStep::Action::make : ConvertStep::Action::make_again;
    forecast.steps.push_back({.clip = clip,
                              .frames = static_cast<int>(source.manifest.frames.size()),
                              .action = backlog.has(clip) ? make : ConvertStep::Action::keep});
  }
  return forecast;
}

/// A dataset being made.
class Dataset {
 public:
  /// `heat` must outlive this object.
  Dataset(ConvertRequest request, const KeptTerms& kept, HeatDays& heat,
          const std::vector<ClipPasses>& sources)
      : request_(std::move(request)),
        heat_(heat),
        kept_(kept),
        left_out_(terms_left_out(kept.budget())),
        transaction_(own_layout(request_), request_.config.document, ids_of(request_.config.spec.clips),
                     to_json(kept.budget())),
        backlog_(backlog_of(request_, transaction_.index(), kept_, sources, heat)) {
    for (const ClipPasses& source : sources) {
      if (!lacks(source)) outcome_.already_there.push_back(source.manifest.clip);
    }
  }

  [[nodiscard]] bool has_changed_passes(const std::string& clip) const {
    return backlog_.changed.contains(clip);
  }

  [[nodiscard]] bool lacks(const ClipPasses& source) const { return backlog_.has(source.manifest.clip); }

  void begin() {
    if (!backlog_.empty()) transaction_.begin();
  }

  [[nodiscard]] ClipTask task_for_clip(const ClipPasses& source) const {
    ClipTask task = task_for(request_, kept_, source, heat_);
    task.folder = transaction_.unfinished(source.manifest.clip);
    return task;
  }

  void commit(const ClipRecord& record) {
    transaction_.commit(record);
    outcome_.made.push_back(record.clip);
    outcome_.frames_made += record.frames;
  }

  void reject(const std::string& clip, const std::string& why) {
    transaction_.reject(clip, why);
    outcome_.failed[clip] = printable(why);
  }

  ConvertOutcome close(const std::vector<ClipPasses>& sources) {
    outcome_.left_over = transaction_.close();
    outcome_.complete = transaction_.index().complete();
    for (const ClipPasses& source : sources) {
      const std::vector<UnusableShare> shares = transaction_.index().unusable({source.manifest.clip});
      outcome_.unusable.insert(outcome_.unusable.end(), shares.begin(), shares.end());
    }
    return {.variant = request_.variant,
            .out = request_.out,
            .run = outcome_,
            .skips = skips_of(sources),
            .left_out = left_out_};
  }

 private:
  [[nodiscard]] std::vector<ClipSkips> skips_of(const std::vector<ClipPasses>& sources) const {
    const auto& skipped = transaction_.index().skipped;
    std::vector<ClipSkips> skips;
    for (const ClipPasses& source : sources) {
      const auto found = skipped.find(source.manifest.clip);
      if (found == skipped.end() || found->second.empty()) continue;
      skips.push_back({.clip = source.manifest.clip, .folder = source.folder, .frames = found->second});
    }
    return skips;
  }

  ConvertRequest request_;
  HeatDays& heat_;
  KeptTerms kept_;
  std::vector<std::string> left_out_;
  DatasetTransaction transaction_;
  Backlog backlog_;
  RunOutcome outcome_;
};

void check_codec(const ConvertRequest& request, const ClipSpec& clip, const Manifest& manifest) {
  const std::optional<VideoCodecSettings>& codec = clip.settings->codec;
  if (!codec) return;
  try {
    check_video_codec(*codec, manifest.frame_rate_hz, manifest.camera.width_px, manifest.camera.height_px);
  } catch (const ConfigError& error) {
    throw ConfigError(request.where.empty() ? error.what() : request.where + ": " + error.what());
  }
}

std::vector<std::unique_ptr<Dataset>> open_datasets(const std::vector<ConvertRequest>& requests,
                                                    const std::vector<ClipPasses>& sources,
                                                    const std::vector<PassesView>& views, HeatDays& heat) {
  // First, because a required term that is impossible, or a missing codec, is a fault: then no folder is touched.
  const std::vector<KeptTerms> kept = terms_of(requests, heat.materials(), sources, views);
  for (const ConvertRequest& request : requests)
    for (std::size_t k = 0; k < sources.size(); ++k)
      check_codec(request, request.config.spec.clips[k], sources[k].manifest);
  std::vector<std::unique_ptr<Dataset>> datasets;
  for (std::size_t i = 0; i < requests.size(); ++i)
    datasets.push_back(std::make_unique<Dataset>(requests[i], kept[i], heat, sources));
  return datasets;
}

/// Makes the missing clips, clip by clip for all the datasets that lack it.
class Converter {
 public:
  Converter(const std::vector<ConvertRequest>& requests, const std::vector<ClipPasses>& sources,
            const MaterialLibrary& materials, const Assets& assets, const RunHooks& hooks)
      : sources_(sources),
        views_(views_to_make(requests, sources)),
        heat_(materials, assets),
        hooks_(hooks),
        datasets_(open_datasets(requests, sources, views_, heat_)) {}

  std::vector<ConvertOutcome> run() {
    make_all();
    std::vector<ConvertOutcome> outcomes;
    for (const auto& dataset : datasets_) outcomes.push_back(dataset->close(sources_));
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
    for (std::size_t i = 0; i < records.size(); ++i) wanted[i]->commit(records[i]);
    if (records.empty()) progress_.done = before + static_cast<int>(source.manifest.frames.size());
  }

  /// Call in a catch block: in strict mode, rethrows.
  void reject(const ClipPasses& source, const std::vector<Dataset*>& wanted, const std::string& why) const {
    for (Dataset* dataset : wanted) dataset->reject(source.manifest.clip, why);
    if (source.bad_frames == BadFrames::fail) throw;
  }

  /// A clip without a readable frame has no terms that fit it.
  std::vector<ClipRecord> make(const ClipPasses& source, const std::vector<Dataset*>& wanted) {
    const PassesView& view = views_[static_cast<std::size_t>(&source - sources_.data())];
    if (!view.fault.empty()) throw DataError(view.fault);
    std::vector<ClipTask> tasks;
    for (const Dataset* dataset : wanted) tasks.push_back(dataset->task_for_clip(source));
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
    return make_clips(source, tasks, heat_.materials(), hooks);
  }

  const std::vector<ClipPasses>& sources_;
  std::vector<PassesView> views_;
  HeatDays heat_;
  const RunHooks& hooks_;
  std::vector<std::unique_ptr<Dataset>> datasets_;
  Progress progress_;
};

std::vector<ClipPasses> read_sources(const ConvertOptions& options, const MaterialLibrary& materials) {
  std::vector<ClipPasses> sources = find_passes(options.passes, options.manifest, materials, options.assets);
  for (ClipPasses& source : sources) {
    source.limits = options.limits;
    source.bad_frames = options.strict ? BadFrames::fail : BadFrames::skip;
  }
  return sources;
}

}  // namespace

std::vector<ConvertForecast> forecast_convert(const ConvertOptions& options) {
  return with_threads(options.threads, [&] {
    const MaterialLibrary materials = read_materials(options.assets);
    const std::vector<ClipPasses> sources = read_sources(options, materials);
    const std::vector<ConvertRequest> requests = convert_requests(options, sources);
    const std::vector<KeptTerms> kept = terms_of(requests, materials, sources, views_of(requests, sources));
    HeatDays heat(materials, options.assets);
    std::vector<ConvertForecast> forecasts;
    for (std::size_t i = 0; i < requests.size(); ++i)
      forecasts.push_back(forecast_of(requests[i], kept[i], sources, heat));
    return forecasts;
  });
}

std::vector<ConvertOutcome> convert(const ConvertOptions& options, const RunHooks& hooks) {
  return with_threads(options.threads, [&] {
    const MaterialLibrary materials = read_materials(options.assets);
    const std::vector<ClipPasses> sources = read_sources(options, materials);
    return Converter(convert_requests(options, sources), sources, materials, options.assets, hooks).run();
  });
}

}  // namespace thermal
