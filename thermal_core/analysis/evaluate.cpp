#include "analysis/evaluate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace thermal {
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
