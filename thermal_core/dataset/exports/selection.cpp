#include "dataset/exports/selection.h"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

using Frames = std::map<std::pair<std::size_t, int>, std::size_t>;  // image by video and frame index

Frames frames_of(const LabelSet& set) {
  Frames frames;
  for (std::size_t i = 0; i < set.images.size(); ++i)
    frames.emplace(std::pair(set.images[i].video, set.images[i].frame_index), i);
  return frames;
}

std::size_t find_video(const LabelSet& set, const std::string& name, const Path& file) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < set.videos.size(); ++i) {
    if (set.videos[i].name == name) return i;
    names.push_back(set.videos[i].name);
  }
  throw DataError(fmt::format("{}: video \"{}\" is not in {}; expected one of {}{}", file.string(), name,
                              set.name, list_names(names), did_you_mean(name, names)));
}

std::vector<bool> taken_images(const LabelSet& set, const SelectedDataset& selected, const Path& file) {
  const Frames frames = frames_of(set);
  std::vector<bool> taken(set.images.size(), false);
  for (const SelectedVideo& video : selected.videos) {
    const std::size_t place = find_video(set, video.name, file);
    for (const int frame : video.frames) {
      const auto image = frames.find({place, frame});
      if (image == frames.end())
        throw DataError(
            fmt::format("{}: video \"{}\" of {} has no frame {}; expected a frame_index of its pictures",
                        file.string(), video.name, set.name, frame));
      taken[image->second] = true;
    }
  }
  return taken;
}

}  // namespace

LabelSet take_selected(const LabelSet& set, const SelectedDataset& selected, const Path& file) {
  const std::vector<bool> taken = taken_images(set, selected, file);
  LabelSet result = set;
  result.images.clear();
  result.labels.clear();
  std::vector<std::size_t> places(set.images.size(), 0);
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    if (!taken[i]) continue;
    places[i] = result.images.size();
    result.images.push_back(set.images[i]);
  }
  for (const Label& label : set.labels) {
    if (!taken[label.image]) continue;
    result.labels.push_back(label);
    result.labels.back().image = places[label.image];
  }
  if (result.images.empty())
    throw DataError(fmt::format("{}: no frame of {}; expected at least one", file.string(), set.name));
  return result;
}

}  // namespace thermal
