#include "dataset/reports/labels.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

#include "dataset/reports/heat.h"
#include "dataset/reports/histograms.h"

namespace thermal {
namespace {

std::vector<std::int64_t> labels_of_each(const LabelSet& set) {
  std::vector<std::int64_t> counts(set.categories.size());
  for (const Label& label : set.labels) ++counts[label.category];
  return counts;
}

/// Names in the order of their indices, without those that have no labels.
std::vector<std::string> ranked_categories(const LabelSet& set, const std::vector<std::size_t>& ranks) {
  const std::vector<std::int64_t> counts = labels_of_each(set);
  std::vector<std::string> names(set.categories.size());
  std::size_t used = 0;
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    names[ranks[k]] = set.categories[k].name;
    if (counts[k] > 0) ++used;
  }
  names.resize(used);
  return names;
}

/// Counts of a category's labels.
struct Count {
  std::array<std::int64_t, 3> of_size{};
  std::int64_t ignored = 0;
  std::int64_t truncated = 0;
  std::optional<std::int64_t> occluded;  ///< where labels have it
  std::int64_t noisy = 0;
  std::set<std::pair<std::size_t, std::int64_t>> tracks;

  void add(const Label& label, std::size_t video) {
    ++of_size.at(static_cast<std::size_t>(label.size));
    ignored += label.ignore ? 1 : 0;
    truncated += label.truncated ? 1 : 0;
    if (label.occluded) occluded = occluded.value_or(0) + (*label.occluded ? 1 : 0);
    noisy += label.noisy ? 1 : 0;
    if (label.track_id) tracks.emplace(video, *label.track_id);
  }

  [[nodiscard]] Json json() const {
    return {{"small", of_size[0]},    {"medium", of_size[1]},
            {"large", of_size[2]},    {"ignored", ignored},
            {"truncated", truncated}, {"occluded", occluded ? Json(*occluded) : Json()},
            {"noisy", noisy},         {"tracks", tracks.size()}};
  }
};

Json counts_of(const LabelSet& set, const std::vector<std::size_t>& ranks, std::size_t used) {
  std::vector<Count> counts(used);
  for (const Label& label : set.labels)
    counts[ranks[label.category]].add(label, set.images[label.image].video);
  Json json = Json::array();
  for (const Count& count : counts) json.push_back(count.json());
  return json;
}

Json videos_of(const LabelSet& set) {
  std::vector<std::int64_t> labels_in(set.images.size());
  std::vector<std::set<std::int64_t>> tracks(set.videos.size());
  for (const Label& label : set.labels) {
    ++labels_in[label.image];
    if (label.track_id) tracks[set.images[label.image].video].insert(*label.track_id);
  }
  std::vector<std::array<std::int64_t, 3>> sums(set.videos.size());  // images, labels, images without
  for (std::size_t k = 0; k < set.images.size(); ++k) {
    auto& [images, labels, negatives] = sums[set.images[k].video];
    ++images;
    labels += labels_in[k];
    negatives += labels_in[k] == 0 ? 1 : 0;
  }
  Json json = Json::array();
  for (std::size_t k = 0; k < set.videos.size(); ++k) {
    json.push_back({{"name", set.videos[k].name},
                    {"frame_rate_hz", set.videos[k].frame_rate_hz},
                    {"images", sums[k][0]},
                    {"labels", sums[k][1]},
                    {"negatives", sums[k][2]},
                    {"tracks", tracks[k].size()}});
  }
  return json;
}

/// Known picture sizes, without repetition.
Json sizes_of(const LabelSet& set) {
  std::set<std::pair<int, int>> sizes;
  for (const LabelImage& image : set.images) {
    if (image.width_px > 0 && image.height_px > 0) sizes.emplace(image.width_px, image.height_px);
  }
  return sizes;
}

using Quantity = std::optional<double> (*)(const Label&);

Json histogram(const LabelSet& set, const std::vector<std::size_t>& ranks, std::size_t used, Bins bins,
               Quantity quantity) {
  std::vector<HistogramValue> values;
  values.reserve(set.labels.size());
  for (const Label& label : set.labels) values.push_back({quantity(label), ranks[label.category]});
  return histogram_of(values, used, bins);
}

Json histograms_of(const LabelSet& set, const std::vector<std::size_t>& ranks, std::size_t used) {
  const auto of = [&](Bins bins, Quantity quantity) { return histogram(set, ranks, used, bins, quantity); };
  return {{"area_px", of(Bins::logarithmic, [](const Label& l) { return std::optional(l.box.area_px()); })},
          {"visibility", of(Bins::share, [](const Label& l) { return l.visibility; })},
          {"contrast_k", of(Bins::linear, [](const Label& l) { return l.contrast_k; })},
          {"contrast_noise", of(Bins::linear, [](const Label& l) { return l.contrast_noise; })},
          {"range_m", of(Bins::linear, [](const Label& l) { return l.range_m; })},
          {"temperature_k", of(Bins::linear, [](const Label& l) { return l.temperature_k; })}};
}

}  // namespace

std::vector<std::size_t> category_ranks(const LabelSet& set) {
  const std::vector<std::int64_t> counts = labels_of_each(set);
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (counts[a] != counts[b]) return counts[a] > counts[b];
    return set.categories[a].name < set.categories[b].name;
  });
  std::vector<std::size_t> ranks(counts.size());
  for (std::size_t k = 0; k < order.size(); ++k) ranks[order[k]] = k;
  return ranks;
}

Json label_figures(const LabelSet& set) {
  const std::vector<std::size_t> ranks = category_ranks(set);
  const std::vector<std::string> names = ranked_categories(set, ranks);
  Json none = Json::array();
  for (std::size_t k = 0; k < set.categories.size(); ++k) {
    if (ranks[k] >= names.size()) none.push_back(set.categories[k].name);
  }
  return {{"images", set.images.size()},
          {"labels", set.labels.size()},
          {"sizes", sizes_of(set)},
          {"categories", names},
          {"unused_categories", std::move(none)},
          {"videos", videos_of(set)},
          {"counts", counts_of(set, ranks, names.size())},
          {"histograms", histograms_of(set, ranks, names.size())},
          {"heat", heat_of(set)}};
}

}  // namespace thermal
