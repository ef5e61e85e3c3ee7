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
Encounter above_score(Encounter encounter, double score) {
  const auto end = std::find_if(encounter.detections.begin(), encounter.detections.end(),
                                [score](const Detection& detection) { return detection.score < score; });
  encounter.detections =
      encounter.detections.first(static_cast<std::size_t>(end - encounter.detections.begin()));
  return encounter;
}

/// Adds the counts of one encounter.
void count(const Encounter& encounter, const LabelSet& truth, double iou, Evaluation& evaluation) {
  SizeCounts& counts = evaluation.counts[truth.images[encounter.image].video][encounter.category];
  for (const Target& target : encounter.targets) {
    if (target.ignored) {
      ++evaluation.ignored_targets;
    } else {
      ++of_size(counts, truth.labels[target.label].size).false_negatives;  // until it is found
    }
  }
  const std::vector<std::size_t> found = match(encounter, iou);
  for (std::size_t d = 0; d < found.size(); ++d) {
    if (found[d] == kNoTarget) {
      ++of_size(counts, size_class_of(encounter.detections[d].box.area_px())).false_positives;
    } else if (encounter.targets[found[d]].ignored) {
      ++evaluation.ignored_detections;
    } else {
      Counts& of_target = of_size(counts, truth.labels[encounter.targets[found[d]].label].size);
      ++of_target.true_positives;
      --of_target.false_negatives;
    }
  }
}

/// Average precision of each category; encounters are sorted by category.
std::vector<AveragePrecision> by_category(std::span<const Encounter> encounters, std::size_t categories) {
  std::vector<AveragePrecision> result;
  for (std::size_t category = 0; category < categories; ++category) {
    const auto end = std::find_if(encounters.begin(), encounters.end(),
                                  [category](const Encounter& e) { return e.category != category; });
    const auto own = static_cast<std::size_t>(end - encounters.begin());
    result.push_back(average_precision_of(encounters.first(own)));
    encounters = encounters.subspan(own);
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
  const Encounters encounters(truth, detections, options.count_ignored);
  Evaluation evaluation;
  evaluation.counts.assign(truth.videos.size(), std::vector<SizeCounts>(truth.categories.size()));
  for (const Encounter& encounter : encounters.all()) {
    count(above_score(encounter, options.score), truth, options.iou, evaluation);
  }
  evaluation.average_precision = by_category(encounters.all(), truth.categories.size());
  evaluation.mean_average_precision = mean_of(evaluation.average_precision);
  return evaluation;
}

}  // namespace thermal
