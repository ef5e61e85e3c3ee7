#include "dataset/plan/plan_checksums.h"

#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/relative_name.h"
#include "io/json/file.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

using Sums = std::map<std::string, std::string>;  ///< SHA-256 by name, relative to the folder

constexpr const char* kName = "checksums.json";

/// IoError, or TryAgainError if the disk is full.
std::vector<std::string> names_in(const Path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (const std::filesystem::recursive_directory_iterator end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file() && !entry->is_symlink())
      names.push_back(entry->path().lexically_relative(folder).string());
  }
  if (error) fail_at("read", folder, error.value());
  std::erase(names, kName);
  return names;
}

/// IoError if one cannot be read.
Sums sums_of(const Path& folder, const std::vector<std::string>& names) {
  std::vector<std::string> sums(names.size());
  parallel_for(names.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) sums[place] = sha256_of_file(folder / names[place]);
  });
  Sums found;
  for (std::size_t place = 0; place < names.size(); ++place) found[names[place]] = sums[place];
  return found;
}

/// DataError if there are none.
Sums recorded_in(const Path& folder) {
  const Path file = folder / kName;
  if (!std::filesystem::exists(file))
    throw DataError(fmt::format("{} is missing; run veldt plan again", file.string()));
  const Json json = read_json(file);
  bool is_sound = json.is_object();
  if (is_sound)
    for (const auto& [name, sum] : json.items())
      is_sound = is_sound && sum.is_string() && RelativeName::of(name).has_value();
  if (!is_sound) throw DataError(fmt::format("{} is damaged; run veldt plan again", file.string()));
  return json.get<Sums>();
}

std::vector<std::string> names_of(const Sums& sums) {
  std::vector<std::string> names;
  for (const auto& [name, sum] : sums) names.push_back(name);
  return names;
}

/// What clips share lies in the folder itself or in a folder that is none of tracks.
bool is_read_for(const std::string& name, const std::set<std::string>& clips) {
  const Path path = name;
  return path.parent_path() != "tracks" || clips.contains(path.stem().string());
}

/// DataError for the first file that is not as recorded.
void check(const Path& folder, const std::vector<std::string>& names, const Sums& recorded) {
  for (const auto& [name, sum] : sums_of(folder, names)) {
    const auto wanted = recorded.find(name);
    if (wanted == recorded.end() || wanted->second != sum)
      throw DataError(fmt::format(
          "{} is damaged, or of another plan: its SHA-256 is {}; {} has {}; run veldt plan again",
          (folder / name).string(), sum, kName, wanted == recorded.end() ? "none" : wanted->second));
  }
}

}  // namespace

void write_checksums(const Path& folder) {
  write_file_atomically(folder / kName, to_text(Json(sums_of(folder, names_in(folder)))));
}

bool has_its_checksums(const Path& folder) {
  try {
    const Sums recorded = recorded_in(folder);
    return sums_of(folder, names_of(recorded)) == recorded;
  } catch (const Error&) {  // missing, or not to be read
    return false;
  }
}

void check_files(const Path& folder, const std::vector<std::string>& names) {
  check(folder, names, recorded_in(folder));
}

void check_files_of_clips(const Path& folder, const std::vector<std::string>& clips) {
  const Sums recorded = recorded_in(folder);
  const std::set<std::string> wanted(clips.begin(), clips.end());
  std::vector<std::string> names = names_of(recorded);
  std::erase_if(names, [&wanted](const std::string& name) { return !is_read_for(name, wanted); });
  check(folder, names, recorded);
}

}  // namespace thermal
