#include "dataset/clip/pass_folders.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/inspect/filled_in.h"
#include "io/exr/cryptomatte.h"
#include "io/image/index_picture.h"
#include "io/manifest_file.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

constexpr std::size_t kNamesTold = 5;

std::string what_is_in(const std::vector<std::string>& names) {
  return names.empty() ? "no file" : list_names(names, kNamesTold);
}

Path folder_of(const Path& file) {
  const Path folder = file.parent_path();
  return folder.empty() ? Path(".") : folder;
}

/// Files that match a pattern's last part; the folders before it are taken literally.
std::vector<FrameName> files_of(const Path& named) {
  const std::string where = "passes";
  const Path folder = folder_of(named);
  if (!std::filesystem::is_directory(folder)) {
    throw ConfigError(
        fault(where, fmt::format("\"{}\"", named.string()), "",
              fmt::format("a pattern in an existing folder, and {} is not one", folder.string())));
  }
  const std::vector<std::string> names = files_in(folder);
  std::vector<FrameName> found = names_matching(NamePattern(named.filename().string(), where), names);
  if (!found.empty()) return found;
  throw ConfigError(
      fault(where, fmt::format("\"{}\"", named.string()), "",
            fmt::format("a pattern of files in {}, which holds {}", folder.string(), what_is_in(names))));
}

PassesGroup group_of(const Path& named) {
  if (std::filesystem::is_directory(named)) return {.folder = named, .files = {}, .named = named.string()};
  PassesGroup group{.folder = folder_of(named), .files = {}, .named = named.string()};
  if (std::filesystem::exists(named)) {
    group.files = {{.name = named.filename().string(), .number = {}}};
  } else if (NamePattern::has_wildcards(named.filename().string())) {
    group.files = files_of(named);
  } else {
    throw ConfigError(
        fault("passes", named.string(), "",
              "a folder of passes, files of passes or a pattern such as \"passes/f_####.exr\""));
  }
  return group;
}

NamePattern pattern_in_manifest(const std::string& pattern, const std::string& where) {
  try {
    return {pattern, where};
  } catch (const ConfigError& error) {  // the file's fault, not the config's
    throw DataError(error.what());
  }
}

FrameSequence matching(const PassesGroup& group, const std::string& pattern, const Path& file) {
  const std::string where = file.string() + ": sequence";
  const std::vector<std::string> names = files_in(group.folder);
  std::vector<FrameName> found = names_matching(pattern_in_manifest(pattern, where), names);
  if (!found.empty()) return sequence_of(std::move(found), group.folder.string());
  throw DataError(fault(
      where, fmt::format("\"{}\"", pattern), "",
      fmt::format("a pattern of files in {}, which holds {}", group.folder.string(), what_is_in(names))));
}

FrameSequence listed(const Manifest& manifest) {
  FrameSequence sequence;
  for (const ManifestFrame& frame : manifest.frames)
    sequence.frames.push_back({.name = {.name = frame.file, .number = {}}, .is_gap = false});
  return sequence;
}

}  // namespace

std::vector<PassesGroup> group_passes(const std::vector<Path>& named) {
  std::vector<PassesGroup> groups;
  for (const Path& path : named) {
    PassesGroup group = group_of(path);
    const auto same = [&group](const PassesGroup& other) {
      return !other.files.empty() && !group.files.empty() &&
             other.folder.lexically_normal() == group.folder.lexically_normal();
    };
    const auto known = std::find_if(groups.begin(), groups.end(), same);
    if (known == groups.end()) {
      groups.push_back(std::move(group));
    } else {
      known->files.insert(known->files.end(), group.files.begin(), group.files.end());
    }
  }
  return groups;
}

FrameSequence frames_of(const PassesGroup& group, const Manifest& manifest, const Path& file, bool take_all) {
  if (!group.files.empty() && !manifest.frames.empty()) {
    throw ConfigError(
        fault("passes", group.named, "",
              fmt::format("the folder, {}: {} lists its frames", group.folder.string(), file.string())));
  }
  if (!manifest.frames.empty()) return listed(manifest);
  if (group.files.empty() && !manifest.sequence.empty()) return matching(group, manifest.sequence, file);
  if (!group.files.empty() || take_all) return frames_of(group);
  throw DataError(
      fmt::format("{}: frames and sequence are missing; expected one of them: a list of files, or a "
                  "pattern of their names such as \"f_####.exr\"",
                  file.string()));
}

FrameSequence frames_of(const PassesGroup& group) {
  std::vector<FrameName> names = group.files.empty() ? passes_among(files_in(group.folder)) : group.files;
  if (!names.empty()) return sequence_of(std::move(names), group.folder.string());
  throw DataError(fmt::format("{} holds no passes; expected .exr files, or .png files of indices",
                              group.folder.string()));
}

namespace {

/// "-" if there is no such file: a skipped frame.
std::string bytes_text(const Path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? "-" : std::to_string(bytes);
}

/// Other files that a frame is made from; none for an unreadable frame.
std::vector<Path> files_beside(const ClipPasses& passes, const Path& frame) {
  if (passes.manifest.cryptomatte.empty() || is_index_picture(frame)) return {};
  try {
    return sidecars_of(read_exr_header(frame));
  } catch (const Error&) {
    return {};
  }
}

bool is_newer(const Path& file, std::filesystem::file_time_type than) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  return !error && written > than;
}

}  // namespace

std::string identity_of(const ClipPasses& passes) {
  Sha256 sum;
  sum.add(passes.manifest.document_sha256 + "\n");
  for (const ManifestFrame& frame : passes.manifest.frames) {
    const Path file = passes.folder / frame.file;
    sum.add(fmt::format("{}\n{}\n", frame.file, bytes_text(file)));
    for (const Path& beside : files_beside(passes, file))
      sum.add(fmt::format("{}\n{}\n", beside.lexically_relative(passes.folder).string(), bytes_text(beside)));
  }
  return sum.hex();
}

bool has_changed(const ClipPasses& passes, const std::string& made_from_sha256, const Path& record_file) {
  if (made_from_sha256 != passes.identity_sha256) return true;
  std::error_code error;
  const auto recorded = std::filesystem::last_write_time(record_file, error);
  return error || std::ranges::any_of(passes.manifest.frames, [&](const ManifestFrame& frame) {
           const Path file = passes.folder / frame.file;
           return is_newer(file, recorded) ||
                  std::ranges::any_of(files_beside(passes, file),
                                      [&](const Path& beside) { return is_newer(beside, recorded); });
         });
}

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
