#include "analysis/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace thermal {
namespace {

constexpr std::uint32_t kHalvings = 20;       // whose mean scatters by about a tenth; estimate
constexpr std::uint32_t kClassifierHalvings = 5;    // each trains five forests
constexpr std::uint32_t kFirstHalving = 100;  // classifiers use the draws below

MeasuredFrames all_of(const SetFigures& set) {
  MeasuredFrames frames;
  for (const FrameFigures& frame : set.frames) frames.push_back(&frame);
  return frames;
}

/// Mean magnitude of the differences between halves, by measure.
KnownValues differences_of_halves(const SetFigures& set, std::uint32_t seed) {
  std::vector<double> sums(measures().size());
  std::vector<double> counts(measures().size());
  for (std::uint32_t draw = 0; draw < kHalvings; ++draw) {
    const Halves halves = halves_of(set.frames, seed, kFirstHalving + draw);
    const KnownValues first = values_of(halves.first);
    const KnownValues second = values_of(halves.second);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      if (!first[k] || !second[k]) continue;
      sums[k] += std::abs(*first[k] - *second[k]);
      counts[k] += 1;
    }
  }
  KnownValues means(sums.size());
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (counts[k] > 0) means[k] = sums[k] / counts[k];
  }
  return means;
}

std::vector<ComparedMeasure> compared(const SetFigures& real, const SetFigures& other, std::uint32_t seed) {
  const KnownValues real_values = values_of(all_of(real));
  const KnownValues other_values = values_of(all_of(other));
  const KnownValues halves = differences_of_halves(real, seed);
  std::vector<ComparedMeasure> rows;
  for (std::size_t k = 0; k < real_values.size(); ++k) {
    ComparedMeasure row = {.real = real_values[k],
                           .other = other_values[k],
                           .difference = {},
                           .real_difference = halves[k],
                           .ratio = {}};
    if (row.real && row.other) row.difference = *row.other - *row.real;
    if (row.difference && row.real_difference && *row.real_difference > 0)
      row.ratio = std::abs(*row.difference) / *row.real_difference;
    rows.push_back(row);
  }
  return rows;
}

using TableOf = FeatureTable (*)(const MeasuredFrames&);

/// Fills in averages over halvings; importances differ from forest to forest, and are left out.
void classify_halves(const SetFigures& real, TableOf table_of, std::size_t features, std::uint32_t seed,
                     Classification& classified) {
  Discrimination mean = {.auc = 0, .error = 0};
  std::vector<double> alone(features);
  for (std::uint32_t draw = 0; draw < kClassifierHalvings; ++draw) {
    const Halves halves = halves_of(real.frames, seed, kFirstHalving + draw);
    const FeatureTable first = table_of(halves.first);
    const FeatureTable second = table_of(halves.second);
    if (!has_two_units(first) || !has_two_units(second)) return;
    const Discrimination one = discriminate(first, second, features, seed);
    mean.auc += one.auc / kClassifierHalvings;
    mean.error += one.error / kClassifierHalvings;
    for (const Importance& feature : one.importances) alone[feature.feature] += feature.alone / kClassifierHalvings;
  }
  classified.real_halves = mean;
  classified.halves_alone = std::move(alone);
}

std::optional<Classification> classify(const SetFigures& real, const SetFigures& other, TableOf table_of,
                                       std::size_t features, std::uint32_t seed) {
  const FeatureTable first = table_of(all_of(real));
  const FeatureTable second = table_of(all_of(other));
  if (!has_two_units(first) || !has_two_units(second)) return {};
  Classification classified = {.sets = discriminate(first, second, features, seed), .real_halves = {}};
  classify_halves(real, table_of, features, seed, classified);
  return classified;
}

}  // namespace

void CompareOptions::validate() const {
  if (most_frames < 4) throw ConfigError(fault("--frames", std::to_string(most_frames), "", "at least 4"));
}

bool ComparedMeasure::is_good() const {
  return ratio ? *ratio <= kGoodRatio : difference && *difference == 0;
}

Halves halves_of(const std::vector<FrameFigures>& frames, std::uint32_t seed, std::uint32_t draw) {
  std::size_t units = 0;
  for (const FrameFigures& frame : frames) units = std::max(units, frame.unit + 1);
  std::vector<bool> in_first(units);
  const std::vector<std::size_t> order = shuffled(units, seed, draw);
  for (std::size_t k = 0; k < (units + 1) / 2; ++k) in_first[order[k]] = true;
  Halves halves;
  for (const FrameFigures& frame : frames)
    (in_first[frame.unit] ? halves.first : halves.second).push_back(&frame);
  return halves;
}

Comparison compare(const CompareOptions& options) {
  options.validate();
  FrameSource real_source = read_frame_source(options.real);
  FrameSource other_source = read_frame_source(options.other);
  if (real_source.kelvin && other_source.kelvin) set_common_levels(real_source, other_source);
  const auto most = static_cast<std::size_t>(options.most_frames);
  const std::size_t reals = std::min(most, real_source.frames.size());
  const std::size_t all = reals + std::min(most, other_source.frames.size());
  const auto show = [&options, all](std::size_t before) {
    return [&options, all, before](std::size_t done, std::size_t) {
      if (options.show) options.show(before + done, all);
    };
  };
  Comparison found = {.real = measure_set(std::move(real_source), most, show(0)),
                      .other = measure_set(std::move(other_source), most, show(reals)),
                      .measures = {},
                      .frames = {},
                      .crops = {}};
  found.measures = compared(found.real, found.other, options.seed);
  found.frames = classify(found.real, found.other, frame_table, frame_features().size(), options.seed);
  found.crops = classify(found.real, found.other, crop_table, crop_features().size(), options.seed);
  return found;
}

}  // namespace thermal
