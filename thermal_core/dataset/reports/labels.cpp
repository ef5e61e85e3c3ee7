#include "dataset/reports/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/order_statistics.h"

namespace thermal {
namespace {

/// The largest of 1, 2, 5, 10, 20 … and 0.1, 0.2, 0.5 … that is at most `width`.
double round_width(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= width * (1 + 1e-9)) return factor * power;
  }
  return power;
}

/// Nearly equal values get fewer bins, so that edges remain distinct numbers.
std::vector<double> linear_edges(double low, double high) {
  constexpr double kBins = 15;      // at least, and fewer than 40
  constexpr double kFinest = 1e-9;  // least bin width, as a share of the larger value or of 1
  const double finest = kFinest * std::max({1.0, std::abs(low), std::abs(high)});
  const double step = high > low ? round_width(std::max(high / kBins - low / kBins, finest))
                                 : round_width(std::max(1e-3, 0.1 * std::abs(low)));
  const auto first = std::floor(low / step);
  const auto last = std::max(first + 1, std::ceil(high / step));
  std::vector<double> edges;
  for (double k = first; k <= last; ++k) edges.push_back(k * step);
  return edges;
}

std::vector<double> logarithmic_edges(double low, double high) {
  constexpr double kToADecade = 5;
  constexpr double kLeast = 0.01;
  std::vector<double> edges;
  const double first = std::floor(kToADecade * std::log10(std::max(low, kLeast)));
  const double last = std::floor(kToADecade * std::log10(std::max(high, kLeast))) + 1;
  for (double k = first; k <= last; ++k) edges.push_back(std::pow(10.0, k / kToADecade));
  return edges;
}

std::size_t bin_of(double value, const std::vector<double>& edges) {
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin() - 1);
}

std::vector<double> known_values(const std::vector<HistogramValue>& values) {
  std::vector<double> known;
  for (const HistogramValue& entry : values) {
    if (entry.value) known.push_back(*entry.value);
  }
  std::sort(known.begin(), known.end());
  return known;
}

}  // namespace

std::vector<double> bin_edges(std::vector<double> values, Bins bins) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  constexpr double kTail = 0.005;
  const double low = nearest_rank(values, kTail);
  const double high = nearest_rank(values, 1 - kTail);
  if (bins == Bins::logarithmic) return logarithmic_edges(low, high);
  if (bins == Bins::linear) return linear_edges(low, high);
  std::vector<double> edges;
  for (int k = 0; k <= 20; ++k) edges.push_back(k / 20.0);
  return edges;
}

Json histogram_of(const std::vector<HistogramValue>& values, std::size_t categories, Bins bins) {
  const std::vector<double> known = known_values(values);
  Json json = {{"known", known.size()}, {"of", values.size()}};
  if (known.empty()) return json;
  const std::vector<double> edges = bin_edges(known, bins);
  std::vector<std::vector<int>> counts(categories, std::vector<int>(edges.size() - 1));
  for (const HistogramValue& entry : values) {
    if (entry.value) ++counts[entry.category][bin_of(*entry.value, edges)];
  }
  json["least"] = known.front();
  json["median"] = nearest_rank(known, 0.5);
  json["most"] = known.back();
  json["below"] = std::lower_bound(known.begin(), known.end(), edges.front()) - known.begin();
  json["above"] = known.end() - std::upper_bound(known.begin(), known.end(), edges.back());
  json["edges"] = edges;
  json["counts"] = counts;
  return json;
}

namespace {

/// A grid of cells over pictures of any size.
class Heat {
 public:
  explicit Heat(double height_to_width)
      : rows_(std::clamp(static_cast<int>(std::lround(kColumns * height_to_width)), 1, 4 * kColumns)),
        covered_(static_cast<std::size_t>(kColumns * rows_)) {}

  /// Adds to each cell the fraction of it that a box covers.
  void add(const LabelBox& box, const LabelImage& image) {
    const double to_columns = 1.0 * kColumns / image.width_px;
    const double to_rows = 1.0 * rows_ / image.height_px;
    const double left = box.x_px * to_columns;
    const double right = left + box.width_px * to_columns;
    const double top = box.y_px * to_rows;
    const double bottom = top + box.height_px * to_rows;
    for (int row = first(top); row < last(bottom, rows_); ++row) {
      for (int column = first(left); column < last(right, kColumns); ++column) {
        covered_[static_cast<std::size_t>(row * kColumns + column)] +=
            overlap(column, left, right) * overlap(row, top, bottom);
      }
    }
  }

  /// Mean over this many pictures.
  [[nodiscard]] Json json(std::size_t pictures) const {
    std::vector<double> mean;
    constexpr double kDigits = 1e5;
    for (const double sum : covered_)
      mean.push_back(std::round(kDigits * sum / static_cast<double>(pictures)) / kDigits);
    return {{"columns", kColumns}, {"rows", rows_}, {"boxes_over", mean}};
  }

 private:
  static constexpr int kColumns = 40;
  static int first(double edge) { return std::max(0, static_cast<int>(std::floor(edge))); }
  static int last(double edge, int count) { return std::min(count, static_cast<int>(std::ceil(edge))); }
  static double overlap(int cell, double low, double high) {
    return std::max(0.0, std::min(high, cell + 1.0) - std::max(low, 1.0 * cell));
  }

  int rows_;
  std::vector<double> covered_;
};

/// Heat map of boxes in the picture, as JSON: `columns`, `rows`, and `boxes_over`, row by row the number of boxes over
/// each cell, averaged over all pictures of known size. Pictures of other sizes than the first's are scaled to it. {}
/// if no picture's size is known.
Json heat_of(const LabelSet& set) {
  const auto has_size = [](const LabelImage& image) { return image.width_px > 0 && image.height_px > 0; };
  const auto sized = std::find_if(set.images.begin(), set.images.end(), has_size);
  if (sized == set.images.end()) return Json::object();
  Heat heat(1.0 * sized->height_px / sized->width_px);
  for (const Label& label : set.labels) {
    if (const LabelImage& image = set.images[label.image]; has_size(image)) heat.add(label.box, image);
  }
  return heat.json(static_cast<std::size_t>(std::count_if(set.images.begin(), set.images.end(), has_size)));
}

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
