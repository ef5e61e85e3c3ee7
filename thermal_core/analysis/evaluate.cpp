#include "analysis/evaluate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"

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

namespace {

constexpr std::size_t kMostDetections = 100;

enum class Outcome : std::uint8_t { missed, found, ignored };

/// A detection's score, and whether it matched at each IoU.
struct Judged {
  double score = 0;
  std::array<Outcome, kIouSteps> outcomes{};
};

void judge(EvaluationCell cell, std::vector<Judged>& judged) {
  cell.detections = cell.detections.first(std::min(cell.detections.size(), kMostDetections));
  const std::size_t before = judged.size();
  for (const Detection& detection : cell.detections) judged.push_back({.score = detection.score});
  const auto steps = iou_steps();
  for (std::size_t step = 0; step < kIouSteps; ++step) {
    const std::vector<std::size_t> found = match(cell, steps[step]);
    for (std::size_t d = 0; d < found.size(); ++d) {
      if (found[d] == kNoTarget) continue;
      judged[before + d].outcomes[step] = cell.targets[found[d]].ignored ? Outcome::ignored : Outcome::found;
    }
  }
}

std::size_t counted_targets(std::span<const EvaluationCell> cells) {
  std::size_t count = 0;
  for (const EvaluationCell& cell : cells) {
    count += static_cast<std::size_t>(std::count_if(cell.targets.begin(), cell.targets.end(),
                                                    [](const Target& target) { return !target.ignored; }));
  }
  return count;
}

/// Mean of the figures that are defined.
template <typename Figure>
std::optional<double> mean_over(std::span<const AveragePrecision> categories, const Figure& figure) {
  double sum = 0;
  int count = 0;
  for (const AveragePrecision& category : categories) {
    if (!figure(category)) continue;
    sum += *figure(category);
    ++count;
  }
  return count == 0 ? std::optional<double>() : sum / count;
}

}  // namespace

std::array<double, kIouSteps> iou_steps() noexcept {
  constexpr double kFirst = 0.5;
  constexpr double kLast = 0.95;
  std::array<double, kIouSteps> steps{};
  for (std::size_t i = 0; i < kIouSteps; ++i) {
    steps[i] = static_cast<double>(i) * ((kLast - kFirst) / (kIouSteps - 1)) + kFirst;
  }
  steps.back() = kLast;
  return steps;
}

double average_precision(const std::vector<bool>& found, std::size_t targets) {
  assert(targets > 0);
  std::vector<double> recalls(found.size());
  std::vector<double> precisions(found.size());
  double right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    right += found[i] ? 1 : 0;
    recalls[i] = right / static_cast<double>(targets);
    precisions[i] = right / static_cast<double>(i + 1);
  }
  for (std::size_t i = found.size(); i-- > 1;) precisions[i - 1] = std::max(precisions[i - 1], precisions[i]);
  constexpr int kRecallSteps = 101;
  double sum = 0;
  for (int step = 0; step < kRecallSteps; ++step) {
    const double recall = step * 0.01;  // rounded like numpy's linspace; step / 100. differs in last bits
    const auto reached = std::lower_bound(recalls.begin(), recalls.end(), recall);
    if (reached != recalls.end()) sum += precisions[static_cast<std::size_t>(reached - recalls.begin())];
  }
  return sum / kRecallSteps;
}

AveragePrecision average_precision_of(std::span<const EvaluationCell> cells) {
  const std::size_t targets = counted_targets(cells);
  if (targets == 0) return {};
  std::vector<Judged> judged;
  for (const EvaluationCell& cell : cells) judge(cell, judged);
  std::stable_sort(judged.begin(), judged.end(),
                   [](const Judged& a, const Judged& b) { return a.score > b.score; });
  AveragePrecision result{.at_50 = 0, .at_50_to_95 = 0};
  for (std::size_t step = 0; step < kIouSteps; ++step) {
    std::vector<bool> found;
    found.reserve(judged.size());
    for (const Judged& one : judged) {
      if (one.outcomes[step] != Outcome::ignored) found.push_back(one.outcomes[step] == Outcome::found);
    }
    const double precision = average_precision(found, targets);
    if (step == 0) result.at_50 = precision;
    *result.at_50_to_95 += precision;
  }
  *result.at_50_to_95 /= kIouSteps;
  return result;
}

AveragePrecision mean_of(std::span<const AveragePrecision> categories) {
  return {.at_50 = mean_over(categories, [](const AveragePrecision& one) { return one.at_50; }),
          .at_50_to_95 = mean_over(categories, [](const AveragePrecision& one) { return one.at_50_to_95; })};
}

namespace {

std::optional<double> share(std::int64_t part, std::int64_t rest) {
  if (part + rest == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(part + rest);
}

Counts& of_size(SizeCounts& counts, SizeClass size) { return counts[static_cast<std::size_t>(size)]; }

void add(SizeCounts& to, const SizeCounts& more) {
  for (std::size_t size = 0; size < to.size(); ++size) to[size] += more[size];
}

/// The leading detections with a sufficient score.
EvaluationCell above_score(EvaluationCell cell, double score) {
  const auto end = std::find_if(cell.detections.begin(), cell.detections.end(),
                                [score](const Detection& detection) { return detection.score < score; });
  cell.detections = cell.detections.first(static_cast<std::size_t>(end - cell.detections.begin()));
  return cell;
}

/// Adds the counts of one cell.
void count(const EvaluationCell& cell, const LabelSet& truth, double iou, Evaluation& evaluation) {
  SizeCounts& counts = evaluation.counts[truth.images[cell.image].video][cell.category];
  for (const Target& target : cell.targets) {
    if (target.ignored) {
      ++evaluation.ignored_targets;
    } else {
      ++of_size(counts, truth.labels[target.label].size).false_negatives;  // until it is found
    }
  }
  const std::vector<std::size_t> found = match(cell, iou);
  for (std::size_t d = 0; d < found.size(); ++d) {
    if (found[d] == kNoTarget) {
      ++of_size(counts, size_class_of(cell.detections[d].box.area_px())).false_positives;
    } else if (cell.targets[found[d]].ignored) {
      ++evaluation.ignored_detections;
    } else {
      Counts& of_target = of_size(counts, truth.labels[cell.targets[found[d]].label].size);
      ++of_target.true_positives;
      --of_target.false_negatives;
    }
  }
}

/// Average precision of each category; cells are sorted by category.
std::vector<AveragePrecision> by_category(std::span<const EvaluationCell> cells, std::size_t categories) {
  std::vector<AveragePrecision> result;
  for (std::size_t category = 0; category < categories; ++category) {
    const auto end = std::find_if(cells.begin(), cells.end(),
                                  [category](const EvaluationCell& e) { return e.category != category; });
    const auto own = static_cast<std::size_t>(end - cells.begin());
    result.push_back(average_precision_of(cells.first(own)));
    cells = cells.subspan(own);
  }
  return result;
}

}  // namespace

void EvaluateOptions::validate() const {
  if (!(iou > 0 && iou <= 1))
    throw ConfigError(fault("--iou", fmt::format("{}", iou), "", "above 0 and at most 1"));
  if (!std::isfinite(score))
    throw ConfigError(fault("--score", fmt::format("{}", score), "", "a finite number"));
}

std::optional<double> Counts::precision() const { return share(true_positives, false_positives); }
std::optional<double> Counts::recall() const { return share(true_positives, false_negatives); }

Counts& Counts::operator+=(const Counts& other) noexcept {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  return *this;
}

Counts total(const SizeCounts& counts) noexcept {
  Counts sum;
  for (const Counts& of_size : counts) sum += of_size;
  return sum;
}

SizeCounts Evaluation::of_video(std::size_t video) const {
  SizeCounts sum;
  for (const SizeCounts& category : counts[video]) add(sum, category);
  return sum;
}

SizeCounts Evaluation::of_category(std::size_t category) const {
  SizeCounts sum;
  for (const std::vector<SizeCounts>& video : counts) add(sum, video[category]);
  return sum;
}

SizeCounts Evaluation::overall() const {
  SizeCounts sum;
  for (std::size_t video = 0; video < counts.size(); ++video) add(sum, of_video(video));
  return sum;
}

Evaluation evaluate(const LabelSet& truth, std::span<const Detection> detections,
                    const EvaluateOptions& options) {
  options.validate();
  const EvaluationCells cells(truth, detections, options.count_ignored);
  Evaluation evaluation;
  evaluation.counts.assign(truth.videos.size(), std::vector<SizeCounts>(truth.categories.size()));
  for (const EvaluationCell& cell : cells.all()) {
    count(above_score(cell, options.score), truth, options.iou, evaluation);
  }
  evaluation.average_precision = by_category(cells.all(), truth.categories.size());
  evaluation.mean_average_precision = mean_of(evaluation.average_precision);
  return evaluation;
}

}  // namespace thermal
