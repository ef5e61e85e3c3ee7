#include "analysis/frame_types.h"

#include <algorithm>
#include <map>

namespace thermal {
namespace {

bool is_counted(const LabelSet& set, const Label& label) {
  return !label.ignore && !label.crowd && kind_of(set.categories[label.category].name) != Kind::vehicle;
}

std::size_t class_of(const LabelSet& set, const Label& label) {
  const bool human = kind_of(set.categories[label.category].name) == Kind::human;
  return static_cast<std::size_t>(label.size) + (human ? 3 : 0);
}

/// Number of labels of each class in each image.
std::vector<ClassCounts> count_labels(const LabelSet& set) {
  std::vector<ClassCounts> counts(set.images.size());
  for (const Label& label : set.labels) {
    if (is_counted(set, label)) ++counts[label.image][class_of(set, label)];
  }
  return counts;
}

}  // namespace

const std::array<std::string, kBalanceClasses>& balance_class_names() {
  static const std::array<std::string, kBalanceClasses> kNames = {
      "small_animal", "medium_animal", "large_animal", "small_poacher", "medium_poacher", "large_poacher"};
  return kNames;
}

ClassCounts BalanceVideo::available() const noexcept {
  ClassCounts sums{};
  for (const FrameType& type : types) {
    for (std::size_t k = 0; k < kBalanceClasses; ++k)
      sums[k] += type.labels[k] * static_cast<std::int64_t>(type.frames.size());
  }
  return sums;
}

std::vector<BalanceVideo> frame_types(const LabelSet& set) {
  std::vector<std::map<ClassCounts, std::vector<int>>> found(set.videos.size());
  const std::vector<ClassCounts> counts = count_labels(set);
  for (std::size_t i = 0; i < set.images.size(); ++i)
    found[set.images[i].video][counts[i]].push_back(set.images[i].frame_index);
  std::vector<BalanceVideo> videos;
  for (std::size_t i = 0; i < set.videos.size(); ++i) {
    BalanceVideo video{.name = set.videos[i].name, .types = {}, .unlabelled = 0};
    for (auto& [labels, frames] : found[i]) {
      std::sort(frames.begin(), frames.end());
      if (labels == ClassCounts{})
        video.unlabelled = frames.size();
      else
        video.types.push_back({labels, std::move(frames)});
    }
    videos.push_back(std::move(video));
  }
  return videos;
}

}  // namespace thermal
