#include "dataset/passes_folders.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/manifest_file.h"

namespace thermal {
namespace {

/// Folders of passes that a path means: itself, or those inside it.
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

/// DataError if the manifest names a material that is not there.
void check_materials(const Manifest& manifest, const Path& file, const MaterialLibrary& materials) {
  try {
    for (std::size_t i = 0; i < manifest.objects.size(); ++i)
      (void)materials.find(manifest.objects[i].material, fmt::format("objects[{}].material", i));
    for (std::size_t i = 0; i < manifest.materials.size(); ++i)
      (void)materials.find(manifest.materials[i].material, fmt::format("materials[{}].material", i));
  } catch (const ConfigError& error) {
    throw DataError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

/// DataError if two folders are of one clip.
void check_clips(const std::vector<ClipPasses>& all) {
  std::map<std::string, Path> seen;
  for (const ClipPasses& passes : all) {
    const auto [first, fresh] = seen.emplace(passes.manifest.clip, passes.folder);
    if (fresh) continue;
    throw DataError(fmt::format("{} and {} are both of clip {}; expected one folder a clip",
                                first->second.string(), passes.folder.string(), passes.manifest.clip));
  }
}

}  // namespace

std::vector<ClipPasses> find_passes(const std::vector<Path>& folders, const Path& manifest,
                                    const MaterialLibrary& materials, const Path& home) {
  if (!manifest.empty() && folders.size() != 1) {
    throw ConfigError(fault("--manifest", manifest.string(), "",
                            fmt::format("one folder of passes beside it, not {}", folders.size())));
  }
  std::vector<Path> meant;
  for (const Path& named : folders) {
    const std::vector<Path> more = manifest.empty() ? folders_of(named) : std::vector<Path>{named};
    meant.insert(meant.end(), more.begin(), more.end());
  }
  std::vector<ClipPasses> all;
  for (const Path& folder : meant) {
    const Path file = manifest.empty() ? folder / "manifest.json" : manifest;
    all.push_back({.manifest = read_manifest(file, home), .folder = folder});
    check_materials(all.back().manifest, file, materials);
  }
  check_clips(all);
  return all;
}

}  // namespace thermal
