#include "dataset/passes/groups.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

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

}  // namespace thermal
