#include "dataset/exports/plan.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"

namespace thermal {
namespace {

void check_inside(const std::string& to, const std::string& file) {
  if (!RelativeName::of(to))
    throw DataError(fault(fmt::format("\"{}\": name of its file", file), fmt::format("\"{}\"", to), "",
                          RelativeName::kRule));
}

}  // namespace

std::vector<std::size_t> first_labels(const LabelSet& set) {
  std::vector<std::size_t> first(set.images.size() + 1, 0);
  for (const Label& label : set.labels) ++first[label.image + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  return first;
}

std::string file_name_of(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == '/' || c == '\\'; }, '_');
  return name;
}

std::string ending_of(const std::string& file) { return std::filesystem::path(file).extension().string(); }

void check_tracks(const LabelSet& set, std::string_view format) {
  std::map<std::pair<std::size_t, std::int64_t>, const Label*> seen;  // by image, track
  for (const Label& label : set.labels) {
    const std::string& file = set.images[label.image].file;
    if (!label.track_id)
      throw DataError(
          fmt::format("annotation {} of {} has no track_id; expected one, as --format {} requires",
                      id_text(label.id), file, format));
    const auto [there, fresh] = seen.emplace(std::pair(label.image, *label.track_id), &label);
    if (!fresh)
      throw DataError(
          fmt::format("annotations {} and {} of {} both have track_id {}; expected one annotation per track",
                      id_text(there->second->id), id_text(label.id), file, *label.track_id));
  }
}

void check_in_time(const LabelSet& set, const LabelImage& image, std::string_view format) {
  const LabelVideo& video = set.videos[image.video];
  if (video.in_time) return;
  throw DataError(
      fmt::format("{}: nothing says in which order its pictures were taken; expected frame_index or frame_id "
                  "of images, or names that differ in a number, as --format {} requires",
                  video.name, format));
}

void check_targets(const ExportPlan& plan, const LabelSet& set) {
  std::map<std::string, std::string> targets;  // by target: source file
  const auto check = [&targets](const std::string& to, const std::string& file) {
    check_inside(to, file);
    const auto [there, fresh] = targets.emplace(to, file);
    if (!fresh)
      throw DataError(fmt::format("\"{}\" and \"{}\" would both become {}; expected names that differ",
                                  there->second, file, to));
  };
  for (const PlannedText& text : plan.texts) check(text.to, text.of.empty() ? text.to : text.of);
  for (const PlannedShard& shard : plan.shards) check(shard.to, shard.to);
  for (const PlannedPicture& picture : plan.pictures) check(picture.to, set.images[picture.image].file);
}

}  // namespace thermal
