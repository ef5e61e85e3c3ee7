#include "dataset/reports/frames.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "dataset/label_source.h"
#include "dataset/reports/labels.h"
#include "io/image/pictures.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

constexpr std::size_t kMostSamples = 18;
constexpr std::size_t kOfVideo = 3;

/// Indices of images by video, and number of labels of each image.
struct Index {
  std::vector<std::vector<std::size_t>> images;
  std::vector<std::size_t> labels;
};

Index index_of(const LabelSet& set) {
  Index index{.images = std::vector<std::vector<std::size_t>>(set.videos.size()),
              .labels = std::vector<std::size_t>(set.images.size())};
  for (std::size_t k = 0; k < set.images.size(); ++k) index.images[set.images[k].video].push_back(k);
  for (const Label& label : set.labels) ++index.labels[label.image];
  return index;
}

/// The samples of one video, most informative first.
std::vector<SampleFrame> samples_of(const std::vector<std::size_t>& images,
                                    const std::vector<std::size_t>& labels) {
  std::vector<std::size_t> order = images;
  std::stable_sort(order.begin(), order.end(),
                   [&labels](std::size_t a, std::size_t b) { return labels[a] > labels[b]; });
  const auto negative =
      std::find_if(order.begin(), order.end(), [&](std::size_t k) { return labels[k] == 0; });
  const auto positives = static_cast<std::size_t>(negative - order.begin());
  std::vector<SampleFrame> samples;
  if (positives > 0) samples.push_back({order.front(), "most labels"});
  if (positives > 2) samples.push_back({order[positives / 2], "median"});
  if (negative != order.end()) samples.push_back({*negative, "no labels"});
  return samples;
}

Json box_of(const Label& label, std::size_t category) {
  Json json = {{"category", category},
               {"box", {label.box.x_px, label.box.y_px, label.box.width_px, label.box.height_px}},
               {"size", size_class_name(label.size)}};
  const auto add = [&json](const char* key, const auto& value) {
    if (value) json[key] = *value;
  };
  add("track", label.track_id);
  add("visibility", label.visibility);
  add("contrast_noise", label.contrast_noise);
  add("range_m", label.range_m);
  if (label.truncated) json["truncated"] = true;
  if (label.ignore) json["ignore"] = true;
  return json;
}

Json boxes_of(const LabelSet& set, const std::vector<std::size_t>& ranks, std::size_t image) {
  const auto before = [](const Label& label, std::size_t at) { return label.image < at; };
  Json boxes = Json::array();
  for (auto label = std::lower_bound(set.labels.begin(), set.labels.end(), image, before);
       label != set.labels.end() && label->image == image; ++label)
    boxes.push_back(box_of(*label, ranks[label->category]));
  return boxes;
}

Json figure_of(const LabelSet& set, const std::vector<std::size_t>& ranks, const SampleFrame& sample) {
  constexpr int kMostPx = 960;
  const LabelImage& image = set.images[sample.image];
  return {{"video", set.videos[image.video].name},
          {"frame", image.frame_index},
          {"why", sample.why},
          {"width_px", image.width_px},
          {"height_px", image.height_px},
          {"picture", "data:image/jpeg;base64," + base64_of(as_jpeg(picture_of(set, image), kMostPx))},
          {"boxes", boxes_of(set, ranks, sample.image)}};
}

}  // namespace

std::vector<SampleFrame> choose_samples(const LabelSet& set) {
  const Index index = index_of(set);
  std::vector<std::size_t> videos;
  for (std::size_t k = 0; k < index.images.size(); ++k) {
    if (!index.images[k].empty()) videos.push_back(k);
  }
  if (videos.empty()) return {};
  const std::size_t shown = std::min(videos.size(), kMostSamples);
  const std::size_t of_each = std::min(kOfVideo, kMostSamples / shown);
  std::vector<SampleFrame> samples;
  for (std::size_t k = 0; k < shown; ++k) {
    std::vector<SampleFrame> found =
        samples_of(index.images[videos[k * videos.size() / shown]], index.labels);
    found.resize(std::min(found.size(), of_each));
    samples.insert(samples.end(), found.begin(), found.end());
  }
  return samples;
}

Json sample_figures(const LabelSet& set, bool all) {
  const std::vector<std::size_t> ranks = category_ranks(set);
  Json frames = Json::array();
  Json missing = Json::array();
  for (const SampleFrame& sample : choose_samples(set)) {
    try {
      frames.push_back(figure_of(set, ranks, sample));
    } catch (const Error&) {
      if (all) throw;
      missing.push_back(set.images[sample.image].file);
    }
  }
  return {{"frames", std::move(frames)}, {"missing", std::move(missing)}};
}

}  // namespace thermal
