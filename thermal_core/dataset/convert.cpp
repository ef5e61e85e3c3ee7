#include "dataset/convert.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip_maker.h"
#include "dataset/dataset_index.h"
#include "dataset/physics.h"
#include "io/manifest_file.h"
#include "io/material_files.h"

namespace thermal {
namespace {

/// One clip's passes.
struct Source {
  Path folder;
  Path manifest_file;
  Manifest manifest;
};

/// Folders of passes that a path means: itself, or those inside it, as in the passes folder of a dataset.
std::vector<Path> folders_of(const Path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw ConfigError(fault("passes", folder.string(), "", "a folder of EXR files with a manifest.json"));
  }
  if (std::filesystem::exists(folder / "manifest.json")) return {folder};
  std::vector<Path> inside;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / "manifest.json")) inside.push_back(entry.path());
  }
  std::sort(inside.begin(), inside.end());
  return inside.empty() ? std::vector<Path>{folder} : inside;
}

std::vector<Source> read_sources(const ConvertOptions& options) {
  if (!options.manifest.empty() && options.passes.size() != 1) {
    throw ConfigError(fault("--manifest", options.manifest.string(), "",
                            fmt::format("one folder of passes beside it, not {}", options.passes.size())));
  }
  std::vector<Source> sources;
  std::map<std::string, Path> seen;
  std::vector<Path> folders;
  for (const Path& named : options.passes) {
    const std::vector<Path> meant = options.manifest.empty() ? folders_of(named) : std::vector<Path>{named};
    folders.insert(folders.end(), meant.begin(), meant.end());
  }
  for (const Path& folder : folders) {
    const Path file = options.manifest.empty() ? folder / "manifest.json" : options.manifest;
    Source source = {.folder = folder, .manifest_file = file, .manifest = read_manifest(file, options.home)};
    const auto [first, fresh] = seen.emplace(source.manifest.clip, folder);
    if (!fresh) {
      throw DataError(fmt::format("{} and {} are both of clip {}; expected one folder a clip",
                                  first->second.string(), folder.string(), source.manifest.clip));
    }
    sources.push_back(std::move(source));
  }
  return sources;
}

/// DataError if the manifest names a material that is not there.
void check_materials(const Source& source, const MaterialLibrary& materials) {
  try {
    for (std::size_t i = 0; i < source.manifest.objects.size(); ++i)
      (void)materials.find(source.manifest.objects[i].material, fmt::format("objects[{}].material", i));
    for (std::size_t i = 0; i < source.manifest.materials.size(); ++i)
      (void)materials.find(source.manifest.materials[i].material, fmt::format("materials[{}].material", i));
  } catch (const ConfigError& error) {
    throw DataError(fmt::format("{}: {}", source.manifest_file.string(), error.what()));
  }
}

/// What stands for a config where none is given.
Json default_document(const std::vector<Source>& sources) {
  Json clips = Json::array();
  for (const Source& source : sources) {
    clips.push_back({{"id", source.manifest.clip},
                     {"season", "winter"},
                     {"frames", source.manifest.frames.size()},
                     {"frame_rate_hz", source.manifest.frame_rate_hz}});
  }
  const std::string scene = sources.front().manifest.scene;
  return {{"name", scene.empty() ? "converted" : scene},
          {"seed", sources.front().manifest.seed},
          {"clips", std::move(clips)}};
}

Config resolve(const ConvertOptions& options, const std::vector<Source>& sources) {
  Json document = options.config.value_or(default_document(sources));
  for (const std::string& setting : options.settings) apply_setting(document, setting);
  return resolve_config(std::move(document), options.config ? options.config_name : "--set", options.home);
}

/// Keeps of a config what is about these clips, so that the dataset is complete once they are made.
Config only_clips_of(Config config, const std::vector<Source>& sources) {
  std::vector<ClipConfig> clips;
  Json documents = Json::array();
  for (const Source& source : sources) {
    clips.push_back(config.clip(source.manifest.clip, source.folder.string() + ": clip"));
    for (const Json& document : config.resolved["clips"]) {
      if (document["id"] == source.manifest.clip) documents.push_back(document);
    }
  }
  config.clips = std::move(clips);
  config.resolved["clips"] = std::move(documents);
  return config;
}

/// Makes the clips that are not there yet.
class Converter {
 public:
  Converter(const ConvertOptions& options, const std::vector<Source>& sources, const Config& config,
            const MaterialLibrary& materials, const RunHooks& hooks)
      : sources_(sources),
        config_(config),
        materials_(materials),
        hooks_(hooks),
        layout_{options.out},
        index_(open_dataset(layout_, config)) {
    std::vector<const Manifest*> manifests;
    for (const Source& source : sources) manifests.push_back(&source.manifest);
    index_.budget = weigh_terms(outline_of(config, materials_, manifests), config.terms);
  }

  RunOutcome run() {
    for (const Source& source : sources_) {
      if (index_.finished.contains(source.manifest.clip)) continue;
      progress_.frames_total += static_cast<int>(source.manifest.frames.size());
    }
    if (!index_.complete() || !index_.recorded) write_dataset(layout_, index_);
    for (const Source& source : sources_) {
      if (index_.finished.contains(source.manifest.clip)) {
        outcome_.already_there.push_back(source.manifest.clip);
      } else {
        try_make(source);
        write_dataset(layout_, index_);
      }
    }
    outcome_.failed = index_.failed;
    outcome_.complete = index_.complete();
    return outcome_;
  }

 private:
  void try_make(const Source& source) {
    const std::string& id = source.manifest.clip;
    progress_.clip = id;
    hooks_.report(progress_);
    const int before = progress_.frames_done;
    try {
      make(source);
      outcome_.made.push_back(id);
      outcome_.frames_made += static_cast<int>(source.manifest.frames.size());
    } catch (const DataError& error) {
      reject(source, error.what(), before);
    } catch (const IoError& error) {
      reject(source, error.what(), before);
    }
  }

  void reject(const Source& source, const std::string& why, int frames_before) {
    index_.failed[source.manifest.clip] = why;
    std::filesystem::remove_all(layout_.unfinished_clip(source.manifest.clip));
    progress_.frames_done = frames_before + static_cast<int>(source.manifest.frames.size());
  }

  void make(const Source& source) {
    const ClipConfig& clip = config_.clip(source.manifest.clip, source.folder.string());
    const ClipTask task = {.clip = clip,
                           .seed = config_.seed,
                           .sensor = config_.sensor,
                           .physics = physics_of(config_, clip, index_.budget.kept),
                           .manifest = source.manifest,
                           .passes = source.folder};
    const ClipHooks clip_hooks = {.wait_for_frame = {},
                                  .frame_done =
                                      [this] {
                                        ++progress_.frames_done;
                                        hooks_.report(progress_);
                                      },
                                  .cancelled = hooks_.cancelled};
    index_.finished[task.clip.id] = make_clip(task, materials_, layout_, clip_hooks);
  }

  const std::vector<Source>& sources_;
  const Config& config_;
  const MaterialLibrary& materials_;
  const RunHooks& hooks_;
  Layout layout_;
  DatasetIndex index_;
  Progress progress_;
  RunOutcome outcome_;
};

}  // namespace

RunOutcome convert(const ConvertOptions& options, const RunHooks& hooks) {
  const ThreadLimit limit(options.threads);
  const std::vector<Source> sources = read_sources(options);
  const MaterialLibrary materials = read_materials(options.home);
  for (const Source& source : sources) check_materials(source, materials);
  const Config config = only_clips_of(resolve(options, sources), sources);
  const FolderLock lock(options.out);
  return Converter(options, sources, config, materials, hooks).run();
}

}  // namespace thermal
