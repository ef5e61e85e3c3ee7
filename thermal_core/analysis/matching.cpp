#include "analysis/matching.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace thermal {
namespace {

/// Indices 0 … count - 1 in the order of `key`; equal keys keep their order.
template <typename Key>
std::vector<std::size_t> order_by(std::size_t count, const Key& key) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

/// Rank of each picture in the order of ids, which ranks equal scores.
std::vector<std::size_t> ranks_of(const std::vector<LabelImage>& images) {
  const auto order = order_by(images.size(), [&images](std::size_t i) { return images[i].id; });
  std::vector<std::size_t> ranks(images.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

std::vector<Detection> sorted_detections(std::span<const Detection> detections,
                                         std::span<const std::size_t> ranks) {
  std::vector<Detection> sorted;
  sorted.reserve(detections.size());
  const auto key = [&](std::size_t i) {
    const Detection& detection = detections[i];
    return std::tuple(detection.category, ranks[detection.image], -detection.score);
  };
  for (const std::size_t i : order_by(detections.size(), key)) sorted.push_back(detections[i]);
  return sorted;
}

std::vector<Target> sorted_targets(const LabelSet& truth, std::span<const std::size_t> ranks,
                                   bool count_ignored) {
  const auto is_ignored = [count_ignored](const Label& label) {
    return label.crowd || (label.ignore && !count_ignored);
  };
  std::vector<Target> sorted;
  sorted.reserve(truth.labels.size());
  const auto key = [&](std::size_t i) {
    const Label& label = truth.labels[i];
    return std::tuple(label.category, ranks[label.image], is_ignored(label));
  };
  for (const std::size_t i : order_by(truth.labels.size(), key)) {
    const Label& label = truth.labels[i];
    sorted.push_back({label.box, label.crowd, is_ignored(label), i});
  }
  return sorted;
}

/// Removes and returns the leading items of `rest` for which `belongs`.
template <typename Item, typename Belongs>
std::span<const Item> take_while(std::span<const Item>& rest, const Belongs& belongs) {
  const auto end = std::find_if_not(rest.begin(), rest.end(), belongs);
  const auto count = static_cast<std::size_t>(end - rest.begin());
  const std::span<const Item> taken = rest.first(count);
  rest = rest.subspan(count);
  return taken;
}

}  // namespace

EvaluationCells::EvaluationCells(const LabelSet& truth, std::span<const Detection> detections,
                                 bool count_ignored) {
  const std::vector<std::size_t> ranks = ranks_of(truth.images);
  detections_ = sorted_detections(detections, ranks);
  targets_ = sorted_targets(truth, ranks, count_ignored);
  // Sort key: category, rank of the picture, picture.
  const auto place = [&ranks](const auto& item) {
    return std::tuple(item.category, ranks[item.image], item.image);
  };
  const auto place_of_target = [&](const Target& target) { return place(truth.labels[target.label]); };
  std::span<const Detection> seen = detections_;
  std::span<const Target> there = targets_;
  while (!seen.empty() || !there.empty()) {
    auto next = seen.empty() ? place_of_target(there.front()) : place(seen.front());
    if (!there.empty()) next = std::min(next, place_of_target(there.front()));
    cells_.push_back(
        {.image = std::get<2>(next),
         .category = std::get<0>(next),
         .detections = take_while(seen, [&](const Detection& d) { return place(d) == next; }),
         .targets = take_while(there, [&](const Target& t) { return place_of_target(t) == next; })});
  }
}

double overlap(const LabelBox& detection, const Target& target) noexcept {
  const LabelBox& box = target.box;
  const double width_px = std::min(detection.width_px + detection.x_px, box.width_px + box.x_px) -
                          std::max(detection.x_px, box.x_px);
  const double height_px = std::min(detection.height_px + detection.y_px, box.height_px + box.y_px) -
                           std::max(detection.y_px, box.y_px);
  if (width_px <= 0 || height_px <= 0) return 0;
  const double shared_px = width_px * height_px;
  // The order of summation affects the last bit, and with it ties.
  const double whole_px =
      target.crowd ? detection.area_px() : detection.area_px() + box.area_px() - shared_px;
  return shared_px / whole_px;
}

std::vector<std::size_t> match(const EvaluationCell& cell, double iou) {
  const std::span<const Target> targets = cell.targets;
  std::vector<std::size_t> found(cell.detections.size(), kNoTarget);
  std::vector<bool> taken(targets.size());
  for (std::size_t d = 0; d < found.size(); ++d) {
    double best = std::min(iou, 1 - 1e-10);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (taken[t] && !targets[t].crowd) continue;
      if (found[d] != kNoTarget && !targets[found[d]].ignored && targets[t].ignored) break;
      const double here = overlap(cell.detections[d].box, targets[t]);
      if (!(here >= best)) continue;  // also false for NaN, from areas too small or large to represent
      best = here;
      found[d] = t;
    }
    if (found[d] != kNoTarget) taken[found[d]] = true;
  }
  return found;
}

}  // namespace thermal
