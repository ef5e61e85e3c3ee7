#include "dataset/run/merge.h"

#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/version.h"
#include "dataset/clip/record.h"
#include "dataset/dataset_file.h"
#include "dataset/run/transaction.h"
#include "io/system/files.h"

namespace thermal {
namespace {

/// A dataset to merge.
struct Source {
  Path root;
  Json document;                                          ///< its dataset.json
  std::map<std::string, std::string> record_sha256 = {};  ///< of clip.json, by clip, as dataset.json has it
};

/// A complete clip in some folder.
struct FoundClip {
  Path folder;
  ClipRecord record;          ///< without its files, of which a dataset has millions
  std::string record_sha256;  ///< its entry in dataset.json; empty without one
};

/// Lacks clips that a run renamed before it was killed, and did not record.
std::map<std::string, std::string> recorded_sums(const Json& document) {
  std::map<std::string, std::string> sums;
  for (const Json& clip : document.at("clips"))
    sums[clip.at("id")] = clip.value("record_sha256", std::string());
  return sums;
}

Source open_source(const Path& root) {
  if (!Layout{root}.is_begun())
    throw ConfigError(fault("DIR", root.string(), "", "a dataset, with a dataset.json"));
  Json document = read_dataset_file(root);
  const auto version = document.at("veldt_version").get<std::string>();
  if (version != kVersion)
    throw ConfigError(fault(root.string() + ": veldt_version", version, "",
                            std::string(kVersion) + ", this program's version"));
  std::map<std::string, std::string> sums = recorded_sums(document);
  return {.root = root, .document = std::move(document), .record_sha256 = std::move(sums)};
}

void check_same_config(const Json& expected, const std::string& whose, const Source& source) {
  const std::vector<std::string> found = differences(expected, source.document.at("config"));
  if (found.empty()) return;
  constexpr std::size_t kMost = 8;
  throw ConfigError(fmt::format("{} and {} have different configs: {}; expected shards of one config", whose,
                                source.root.string(), list_names(found, kMost)));
}

/// Checks that all have one config: `document.physics` follows from it.
std::vector<Source> open_sources(const MergeOptions& options, MergeOutcome& outcome) {
  std::vector<Source> sources;
  for (const Path& root : options.sources) {
    if (std::error_code error; std::filesystem::equivalent(root, options.out, error) && !error)
      throw ConfigError(
          fault("--out", options.out.string(), "",
                "a folder that is not among DIR; to add the others to it, leave it out of DIR"));
    if (options.config && !Layout{root}.is_begun()) {
      outcome.left_out.emplace_back(root, "it has no dataset.json");
      continue;
    }
    sources.push_back(open_source(root));
    if (options.config) check_same_config(options.config->document, "the plan", sources.back());
    check_same_config(sources.front().document.at("config"), sources.front().root.string(), sources.back());
  }
  if (sources.empty()) throw ConfigError("none of DIR has a dataset.json; expected shards of a dataset");
  return sources;
}

std::vector<std::string> clips_of(const Source& source) {
  std::vector<std::string> ids;
  for (const Json& clip : source.document.at("clips")) ids.push_back(clip.at("id"));
  return ids;
}

std::optional<FoundClip> find_clip(const Source& source, const std::string& id) {
  const Path folder = Layout{source.root}.clip(id);
  if (!std::filesystem::exists(folder / "clip.json")) return std::nullopt;
  const auto recorded = source.record_sha256.find(id);
  return FoundClip{.folder = folder,
                   .record = read_clip_record(folder / "clip.json"),
                   .record_sha256 = recorded == source.record_sha256.end() ? "" : recorded->second};
}

/// Pictures and labels; their encoding in files may differ between machines' libraries.
bool same_content(const ClipRecord& one, const ClipRecord& other) {
  const auto sum = [](const ClipRecord& record, const char* name) {
    const auto file = record.files.find(name);
    return file == record.files.end() ? std::string() : file->second;
  };
  return one.pixels_sha256 == other.pixels_sha256 && sum(one, "labels.json") == sum(other, "labels.json");
}

/// The clip in each folder that has it. DataError if they differ.
std::vector<FoundClip> find_in_all(const std::vector<Source>& sources, const std::string& id) {
  std::vector<FoundClip> all;
  for (const Source& source : sources) {
    std::optional<FoundClip> found = find_clip(source, id);
    if (!found) continue;
    if (!all.empty() && !same_content(all.front().record, found->record))
      throw DataError(fmt::format("{} and {} differ; expected the same pixels and labels",
                                  all.front().folder.string(), found->folder.string()));
    all.push_back(*std::move(found));
  }
  for (FoundClip& clip : all) clip.record.files.clear();
  return all;
}

void check_file(const Path& file, const std::string& sum) {
  if (!std::filesystem::exists(file)) throw DataError(file.string() + ": missing");
  if (sha256_of_file(file) != sum) throw DataError(file.string() + ": changed since it was written");
}

class Merger {
 public:
  Merger(const MergeOptions& options, const RunHooks& hooks)
      : options_(options),
        hooks_(hooks),
        sources_(open_sources(options, outcome_)),
        transaction_({options.out}, sources_.front().document.at("config"), clips_of(sources_.front()),
                     sources_.front().document.value("physics", Json())) {}

  MergeOutcome run() {
    plan();
    if (!plan_.empty()) transaction_.begin();
    for (const auto& [id, found] : plan_) try_add(id, found);
    outcome_.run.left_over = transaction_.close();
    outcome_.run.complete = transaction_.index().complete();
    find_shards();
    return outcome_;
  }

 private:
  /// Finds every clip, and every fault of the request, before anything is written.
  void plan() {
    std::vector<Source> with_out = {{.root = options_.out, .document = Json::object()}};
    with_out.insert(with_out.end(), sources_.begin(), sources_.end());
    for (const std::string& id : transaction_.index().clips) {
      const std::vector<FoundClip> found = find_in_all(with_out, id);
      if (found.empty()) {
        outcome_.missing.push_back(id);
      } else if (transaction_.index().finished.contains(id)) {
        outcome_.run.already_there.push_back(id);
      } else {
        progress_.total += found.front().record.frames;
        plan_.emplace_back(id, found);
      }
    }
  }

  void find_shards() {
    if (!options_.config || options_.shards == 0) return;
    const DatasetSpec& spec = options_.config->spec;
    const std::vector<int> shards = deal_shards(spec, options_.shards);
    const auto& finished = transaction_.index().finished;
    std::set<int> found;
    for (std::size_t clip_index = 0; clip_index < shards.size(); ++clip_index)
      if (!finished.contains(spec.clips[clip_index].id)) found.insert(shards[clip_index]);
    outcome_.shards_to_make.assign(found.begin(), found.end());
  }

  /// From the first folder with unchanged files of the clip.
  void try_add(const std::string& id, const std::vector<FoundClip>& found) {
    progress_.clip = id;
    hooks_.report(progress_);
    const int before = progress_.done;
    std::string why;
    for (const FoundClip& clip : found) {
      progress_.done = before;
      try {
        add(clip);
        return;
      } catch (const DataError& fault) {
        if (why.empty()) why = fault.what();
      }
    }
    transaction_.reject(id, why);
    outcome_.run.failed[id] = why;
    progress_.done = before + found.front().record.frames;
    hooks_.report(progress_);
  }

  void add(const FoundClip& clip) {
    const Path file = clip.folder / "clip.json";
    if (!clip.record_sha256.empty()) check_file(file, clip.record_sha256);
    const ClipRecord record = read_clip_record(file);
    const Path part = transaction_.unfinished(record.clip);
    make_fresh_folder(part);
    for (const auto& [name, sum] : record.files) add_file(clip.folder / name, part / name, sum);
    link_file(file, part / "clip.json", options_.linking);
    transaction_.commit(record);
    outcome_.run.made.push_back(record.clip);
    outcome_.run.frames_made += record.frames;
  }

  void add_file(const Path& file, const Path& as, const std::string& sum) {
    if (hooks_.stop_wanted()) throw Cancelled();
    check_file(file, sum);
    link_file(file, as, options_.linking);
    if (as.parent_path().filename() != "ir8") return;
    ++progress_.done;
    hooks_.report(progress_);
  }

  const MergeOptions& options_;
  const RunHooks& hooks_;
  MergeOutcome outcome_;
  std::vector<Source> sources_;
  DatasetTransaction transaction_;
  std::vector<std::pair<std::string, std::vector<FoundClip>>> plan_;
  Progress progress_;
};

}  // namespace

MergeOutcome merge(const MergeOptions& options, const RunHooks& hooks) {
  return Merger(options, hooks).run();
}

}  // namespace thermal
