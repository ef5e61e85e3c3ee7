#include "analysis/average_precision.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace thermal {
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

}  // namespace thermal
