#include "dataset/videos/clip_source.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

ClipSource clip_of_folder(const Path& path, const std::vector<std::string>& ids) {
  const Path folder = std::filesystem::canonical(path);
  ClipSource source{.dataset = read_filmed_dataset(folder.parent_path().parent_path()),
                    .clips = {folder.filename().string()},
                    .chosen = true};
  if (!ids.empty())
    throw ConfigError(
        fault("--clips", list_names(ids), "", fmt::format("none, because {} is one clip", path.string())));
  source.dataset.check_clips(source.clips);
  return source;
}

}  // namespace

std::vector<std::string> ClipSource::not_made() const {
  std::vector<std::string> ids;
  if (!chosen)
    std::ranges::copy_if(dataset.clips, std::back_inserter(ids), [this](const std::string& id) {
      return std::ranges::find(dataset.made, id) == dataset.made.end();
    });
  return ids;
}

ClipSource find_clip_source(const Path& path, const std::vector<std::string>& ids) {
  if (!Layout{path}.is_begun() && std::filesystem::exists(path / "clip.json"))
    return clip_of_folder(path, ids);
  ClipSource source{.dataset = read_filmed_dataset(path), .clips = ids, .chosen = !ids.empty()};
  source.dataset.check_clips(ids);
  if (!source.chosen) source.clips = source.dataset.made;
  if (source.clips.empty())
    throw DataError(fmt::format("{}: none of {} clips is made; expected at least one", path.string(),
                                source.dataset.clips.size()));
  return source;
}

}  // namespace thermal
