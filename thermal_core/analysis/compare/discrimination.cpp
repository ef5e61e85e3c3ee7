#include "analysis/compare/discrimination.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include "base/order_statistics.h"
#include "base/parallel.h"
#include "base/rng.h"

namespace thermal {
namespace {

constexpr std::size_t kMostRows = 400;
constexpr std::size_t kParts = 5;
constexpr int kTrees = 100;
constexpr int kDepth = 8;
constexpr std::uint32_t kShuffles = 5;  // of a feature, over which its decrease is averaged

/// Rows of both sets with all values known.
struct Cases {
  cv::Mat features;            ///< CV_32F, a row each
  std::vector<float> targets;  ///< 0: first set, 1: second
  std::vector<std::size_t> parts;

  [[nodiscard]] int count() const noexcept { return features.rows; }
};

std::size_t units_in(const FeatureTable& table) {
  return table.units.empty() ? 0 : *std::max_element(table.units.begin(), table.units.end()) + 1;
}

/// Median of the known values of a feature in both tables.
float typical_of(const FeatureTable& first, const FeatureTable& second, std::size_t feature) {
  std::vector<double> known = known_values(first, feature);
  for (const double value : known_values(second, feature)) known.push_back(value);
  return static_cast<float>(median_of(std::move(known)));
}

void add_cases(const FeatureTable& table, float target, std::size_t parts, std::uint32_t seed,
               const std::vector<float>& typical, Cases& cases) {
  const std::vector<std::size_t> order = shuffled(units_in(table), seed, target > 0 ? 1 : 0);
  std::vector<std::size_t> part_of(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) part_of[order[k]] = k % parts;
  for (const std::size_t k : evenly(table.rows.size(), kMostRows)) {
    cv::Mat row(1, static_cast<int>(typical.size()), CV_32F);
    for (std::size_t f = 0; f < typical.size(); ++f) {
      const auto& value = table.rows[k][f];
      row.at<float>(0, static_cast<int>(f)) = value ? static_cast<float>(*value) : typical[f];
    }
    cases.features.push_back(row);
    cases.targets.push_back(target);
    cases.parts.push_back(part_of[table.units[k]]);
  }
}

cv::Ptr<cv::ml::RTrees> trained(const Cases& cases, std::size_t left_out) {
  cv::Mat features;
  cv::Mat targets;
  for (int k = 0; k < cases.count(); ++k) {
    const auto index = static_cast<std::size_t>(k);
    if (cases.parts[index] == left_out) continue;
    features.push_back(cases.features.row(k));
    targets.push_back(cases.targets[index]);
  }
  const auto forest = cv::ml::RTrees::create();
  forest->setMaxDepth(kDepth);
  forest->setMinSampleCount(2);
  forest->setRegressionAccuracy(0);
  forest->setCalculateVarImportance(false);
  forest->setTermCriteria({cv::TermCriteria::MAX_ITER, kTrees, 0});
  cv::setRNGSeed(1);  // of this thread's generator, which the forest draws from
  forest->train(features, cv::ml::ROW_SAMPLE, targets);
  return forest;
}

WonPairs won_by(const cv::ml::RTrees& forest, const cv::Mat& features, const std::vector<float>& targets) {
  cv::Mat scores;
  forest.predict(features, scores);
  std::vector<double> negative;
  std::vector<double> positive;
  for (int k = 0; k < features.rows; ++k)
    (targets[static_cast<std::size_t>(k)] > 0 ? positive : negative)
        .push_back(static_cast<double>(scores.at<float>(k)));
  return won_pairs(negative, positive);
}

/// Results of one part: with the original features, and with each one shuffled.
struct PartResult {
  WonPairs plain;
  std::vector<double> shuffled_won;
};

PartResult tested(const Cases& cases, std::size_t part, std::uint32_t seed) {
  const auto forest = trained(cases, part);
  cv::Mat features;
  std::vector<float> targets;
  for (int k = 0; k < cases.count(); ++k) {
    if (cases.parts[static_cast<std::size_t>(k)] != part) continue;
    features.push_back(cases.features.row(k));
    targets.push_back(cases.targets[static_cast<std::size_t>(k)]);
  }
  PartResult result = {.plain = won_by(*forest, features, targets),
                       .shuffled_won = std::vector<double>(static_cast<std::size_t>(features.cols))};
  for (int f = 0; f < features.cols; ++f) {
    for (std::uint32_t draw = 0; draw < kShuffles; ++draw) {
      cv::Mat changed = features.clone();
      const std::vector<std::size_t> order = shuffled(targets.size(), seed, 2 + draw);
      for (int k = 0; k < features.rows; ++k)
        changed.at<float>(k, f) = features.at<float>(static_cast<int>(order[static_cast<std::size_t>(k)]), f);
      result.shuffled_won[static_cast<std::size_t>(f)] += won_by(*forest, changed, targets).won / kShuffles;
    }
  }
  return result;
}

/// Hanley and McNeil, Radiology 143 (1982), equation 1, with their exponential approximation of Q1 and Q2.
double standard_error(double auc, double negatives, double positives) {
  const double q1 = auc / (2 - auc);
  const double q2 = 2 * auc * auc / (1 + auc);
  const double variance =
      (auc * (1 - auc) + (positives - 1) * (q1 - auc * auc) + (negatives - 1) * (q2 - auc * auc)) /
      (negatives * positives);
  return std::sqrt(std::max(0.0, variance));
}

Discrimination summed_up(const std::vector<PartResult>& results) {
  WonPairs all;
  std::vector<double> shuffled_won(results[0].shuffled_won.size());
  for (const PartResult& result : results) {
    all.won += result.plain.won;
    all.pairs += result.plain.pairs;
    for (std::size_t f = 0; f < shuffled_won.size(); ++f) shuffled_won[f] += result.shuffled_won[f];
  }
  if (all.pairs == 0) return {};
  Discrimination found = {.auc = all.won / all.pairs};
  for (std::size_t f = 0; f < shuffled_won.size(); ++f)
    found.importances.push_back({f, (all.won - shuffled_won[f]) / all.pairs});
  return found;
}

/// Decreases below the shuffles' own scatter count as equal.
void sort_importances(std::vector<Importance>& importances) {
  const auto rank = [](const Importance& one) { return std::pair(std::lround(1000 * one.fall), one.alone); };
  std::stable_sort(importances.begin(), importances.end(),
                   [&rank](const Importance& a, const Importance& b) { return rank(a) > rank(b); });
}

}  // namespace

bool has_two_units(const FeatureTable& table) {
  return std::any_of(table.units.begin(), table.units.end(), [](std::size_t unit) { return unit > 0; });
}

std::vector<double> known_values(const FeatureTable& table, std::size_t feature) {
  std::vector<double> values;
  for (const auto& row : table.rows) {
    if (row[feature]) values.push_back(*row[feature]);
  }
  return values;
}

double separation_alone(const FeatureTable& first, const FeatureTable& second, std::size_t feature) {
  const WonPairs pairs = won_pairs(known_values(first, feature), known_values(second, feature));
  return pairs.pairs > 0 ? 0.5 + std::abs(pairs.won / pairs.pairs - 0.5) : 0.5;
}

WonPairs won_pairs(const std::vector<double>& negative, const std::vector<double>& positive) {
  std::vector<double> sorted = negative;
  std::sort(sorted.begin(), sorted.end());
  WonPairs pairs = {.won = 0,
                    .pairs = static_cast<double>(negative.size()) * static_cast<double>(positive.size())};
  for (const double score : positive) {
    const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), score);
    pairs.won += 0.5 * static_cast<double>((low - sorted.begin()) + (high - sorted.begin()));
  }
  return pairs;
}

std::vector<std::size_t> shuffled(std::size_t count, std::uint32_t seed, std::uint32_t draw) {
  std::vector<float> keys(count);
  fill_uniform({.seed = seed, .stream = 0, .clip = hash_name("compare"), .frame = draw}, 0, keys);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  return order;
}

Discrimination discriminate(const FeatureTable& first, const FeatureTable& second, std::size_t features,
                            std::uint32_t seed) {
  std::vector<float> typical(features);
  for (std::size_t f = 0; f < features; ++f) typical[f] = typical_of(first, second, f);
  const std::size_t parts = std::min({kParts, units_in(first), units_in(second)});
  Cases cases;
  add_cases(first, 0, parts, seed, typical, cases);
  add_cases(second, 1, parts, seed, typical, cases);
  std::vector<PartResult> results(parts);
  parallel_for(parts, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) results[part] = tested(cases, part, seed);
  });
  Discrimination found = summed_up(results);
  for (Importance& one : found.importances) one.alone = separation_alone(first, second, one.feature);
  sort_importances(found.importances);
  found.error =
      standard_error(found.auc, static_cast<double>(units_in(first)), static_cast<double>(units_in(second)));
  return found;
}

}  // namespace thermal
