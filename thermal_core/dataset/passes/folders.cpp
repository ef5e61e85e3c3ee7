#include "dataset/passes/folders.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "dataset/inspect/filled_in.h"
#include "dataset/passes/groups.h"
#include "dataset/passes/identity.h"
#include "io/assets.h"
#include "io/manifest_file.h"

namespace thermal {
namespace {

constexpr const char* kManifest = "manifest.json";

/// Whether a file of any kind exists.
bool is_there(const Path& file) {
  std::error_code ignored;
  return std::filesystem::symlink_status(file, ignored).type() != std::filesystem::file_type::not_found;
}

/// The clips in a folder without passes of its own, each in its own folder; otherwise the group.
std::vector<PassesGroup> clips_of(const PassesGroup& group) {
  if (!group.files.empty() || is_there(group.folder / kManifest)) return {group};
  std::vector<PassesGroup> inside;
  for (const auto& entry : std::filesystem::directory_iterator(group.folder)) {
    if (!is_there(entry.path() / kManifest)) continue;
    inside.push_back({.folder = entry.path(), .files = {}, .named = group.named});
  }
  std::sort(inside.begin(), inside.end(),
            [](const PassesGroup& a, const PassesGroup& b) { return a.folder < b.folder; });
  return inside.empty() ? std::vector<PassesGroup>{group} : inside;
}

std::vector<PassesGroup> groups_of(const std::vector<Path>& named, const Path& manifest) {
  std::vector<PassesGroup> groups = group_passes(named);
  if (!manifest.empty() && groups.size() != 1) {
    throw ConfigError(fault("--manifest", manifest.string(), "",
                            fmt::format("a single folder of passes with it, not {}", groups.size())));
  }
  if (!manifest.empty()) return groups;
  std::vector<PassesGroup> clips;
  for (const PassesGroup& group : groups) {
    const std::vector<PassesGroup> more = clips_of(group);
    clips.insert(clips.end(), more.begin(), more.end());
  }
  return clips;
}

Manifest read_meaning(const PassesGroup& group, const Path& file, const Assets& assets) {
  if (is_there(file)) {
    if (file.parent_path() == group.folder) check_is_file(file);  // --manifest may also be a pipe: <(…)
    return read_manifest(file, assets);
  }
  throw IoError(
      fmt::format("cannot read {}: no such file; expected one that says what the passes mean, "
                  "such as \"veldt inspect {} --starter-manifest {}\" writes",
                  file.string(), group.folder.string(), file.string()));
}

/// Frames without a list get their files, and times by position.
void take_frames(Manifest& manifest, const FrameSequence& sequence) {
  if (!manifest.frames.empty()) return;
  for (const auto& [name, is_gap] : sequence.frames) {
    ManifestFrame frame;
    frame.file = name.name;  // also for gaps, which are reported as unreadable
    frame.time_s = static_cast<double>(manifest.frames.size()) / manifest.frame_rate_hz;
    manifest.frames.push_back(std::move(frame));
  }
}

/// DataError if a clip has two folders.
void check_clips(const std::vector<ClipPasses>& all) {
  std::map<std::string, Path> seen;
  for (const ClipPasses& passes : all) {
    const auto [first, fresh] = seen.emplace(passes.manifest.clip, passes.folder);
    if (fresh) continue;
    throw DataError(fmt::format("{} and {} both hold clip {}; expected one folder per clip",
                                first->second.string(), passes.folder.string(), passes.manifest.clip));
  }
}

}  // namespace

std::vector<ClipPasses> find_passes(const std::vector<Path>& named, const Path& manifest,
                                    const MaterialLibrary& materials, const Assets& assets) {
  std::vector<ClipPasses> all;
  for (const PassesGroup& group : groups_of(named, manifest)) {
    const Path file = manifest.empty() ? group.folder / kManifest : manifest;
    Manifest meaning = read_meaning(group, file, assets);
    check_filled_in(meaning, file, materials);
    take_frames(meaning, frames_of(group, meaning, file, !manifest.empty()));
    all.push_back({.manifest = std::move(meaning), .folder = group.folder});
    all.back().identity_sha256 = identity_of(all.back());
  }
  check_clips(all);
  return all;
}

}  // namespace thermal
