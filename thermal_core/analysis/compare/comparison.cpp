#include "analysis/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/order_statistics.h"

namespace thermal {
namespace {

constexpr std::uint32_t kHalvings = 20;           // whose mean scatters by about a tenth; estimate
constexpr std::uint32_t kClassifierHalvings = 5;  // each trains five forests
constexpr std::uint32_t kFirstHalving = 100;      // classifiers use the draws below

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
    for (const Importance& feature : one.importances)
      alone[feature.feature] += feature.alone / kClassifierHalvings;
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

namespace {

Json value_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json measure_json(const Measure& measure, const ComparedMeasure& row) {
  return {{"group", measure.group},
          {"name", measure.name},
          {"unit", measure.unit},
          {"real", value_or_null(row.real)},
          {"dataset", value_or_null(row.other)},
          {"difference", value_or_null(row.difference)},
          {"real_difference", value_or_null(row.real_difference)},
          {"ratio", value_or_null(row.ratio)},
          {"good", row.is_good()}};
}

Json measures_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (std::size_t k = 0; k < comparison.measures.size(); ++k)
    rows.push_back(measure_json(measures()[k], comparison.measures[k]));
  return rows;
}

Json classification_json(const std::optional<Classification>& classified,
                         const std::vector<std::string>& features) {
  if (!classified) return {};
  Json importances = Json::array();
  for (const Importance& one : classified->sets.importances) {
    importances.push_back(
        {{"feature", features[one.feature]},
         {"fall", one.fall},
         {"alone", one.alone},
         {"real_alone",
          classified->halves_alone.empty() ? Json() : Json(classified->halves_alone[one.feature])}});
  }
  Json halves;
  if (classified->real_halves)
    halves = {{"auc", classified->real_halves->auc}, {"error", classified->real_halves->error}};
  return {{"auc", classified->sets.auc},
          {"error", classified->sets.error},
          {"real_halves", std::move(halves)},
          {"importances", std::move(importances)}};
}

Json spread_json(const MeanAndDeviation& spread) {
  return {{"mean", spread.mean}, {"deviation", spread.deviation}};
}

Json margins_json(const SetFigures& set, MarginsBy by) {
  Json rows = Json::array();
  for (const MarginRow& row : margins_by_size(set, by)) {
    rows.push_back({{"from_px", row.from_px},
                    {"to_px", row.to_px > 0 ? Json(row.to_px) : Json()},
                    {"targets", row.targets},
                    {"left_px", spread_json(row.left_px)},
                    {"right_px", spread_json(row.right_px)},
                    {"top_px", spread_json(row.top_px)},
                    {"bottom_px", spread_json(row.bottom_px)}});
  }
  return rows;
}

Json altitudes_json(const SetFigures& set) {
  Json rows = Json::array();
  for (const AltitudeRow& row : targets_by_altitude(set)) {
    rows.push_back({{"from_m", row.from_m},
                    {"to_m", row.to_m},
                    {"targets", row.targets},
                    {"width_px", row.width_px},
                    {"height_px", row.height_px},
                    {"contrast", row.contrast},
                    {"ring_deviation", row.ring_deviation}});
  }
  return rows;
}

Json sizes_json(const SetFigures& set) {
  std::map<std::pair<int, int>, std::size_t> sizes;
  for (const FrameFigures& frame : set.frames) ++sizes[{frame.width_px, frame.height_px}];
  Json rows = Json::array();
  for (const auto& [size, frames] : sizes)
    rows.push_back({{"width_px", size.first}, {"height_px", size.second}, {"frames", frames}});
  return rows;
}

/// Mean over frames of the shares of grey levels.
Json histogram_json(const SetFigures& set) {
  std::vector<double> shares(kGreyLevels);
  for (const FrameFigures& frame : set.frames) {
    for (std::size_t level = 0; level < kGreyLevels; ++level)
      shares[level] += frame.grey.shares[level] / static_cast<double>(set.frames.size());
  }
  return shares;
}

/// Power between curve_edges(), averaged over the frames that have any frequency there.
Json curve_json(const SetFigures& set) {
  Json powers = Json::array();
  for (std::size_t bin = 0; bin + 1 < curve_edges().size(); ++bin) {
    std::vector<double> known;
    for (const FrameFigures& frame : set.frames) {
      if (frame.power.curve[bin] > 0) known.push_back(frame.power.curve[bin]);
    }
    powers.push_back(known.empty() ? Json() : Json(mean_of(known)));
  }
  return powers;
}

Json still_json(const std::optional<StillFootage>& still) {
  if (!still) return {};
  return {{"runs", still->runs},       {"frames_of_a_run", kStillFrames}, {"random", still->noise.random},
          {"rows", still->noise.rows}, {"columns", still->noise.columns}, {"frames", still->noise.frames}};
}

Json row_json(const KnownValues& values) {
  Json row = Json::array();
  for (const auto& value : values) row.push_back(value_or_null(value));
  return row;
}

Json frame_crops_json(const FrameFigures& frame) {
  const FeatureTable features = crop_table({&frame});
  Json crops = Json::array();
  for (std::size_t k = 0; k < frame.crops.size(); ++k) {
    const TargetCrop& crop = frame.crops[k];
    Json one = {{"box", {crop.box.x_px, crop.box.y_px, crop.box.width_px, crop.box.height_px}},
                {"features", row_json(features.rows[k])}};
    if (crop.margins) {
      const BoxMargins& margins = *crop.margins;
      one["margins_px"] = {margins.left_px, margins.right_px, margins.top_px, margins.bottom_px};
    }
    crops.push_back(std::move(one));
  }
  return crops;
}

std::vector<double> edge_widths_px(const FrameFigures& frame) {
  std::vector<double> widths;
  for (const Edge& edge : frame.edges) widths.push_back(edge.width_px);
  return widths;
}

Json each_json(const SetFigures& set) {
  Json frames = Json::array();
  for (const FrameFigures& frame : set.frames) {
    const SourceFrame& source = set.source.frames[frame.frame];
    frames.push_back({{"file", source.name},
                      {"unit", frame.unit},
                      {"altitude_m", value_or_null(source.altitude_m)},
                      {"features", row_json(frame_table({&frame}).rows[0])},
                      {"edge_widths_px", edge_widths_px(frame)},
                      {"targets", frame_crops_json(frame)}});
  }
  return frames;
}

Json set_json(const SetFigures& set, bool each) {
  const TargetCounts counts = target_counts(set);
  Json json = {{"source", set.source.name},
               {"veldt_dataset", set.source.is_dataset},
               {"frames_listed", set.source.frames.size()},
               {"frames", set.frames.size()},
               {"rejected", set.rejected},
               {"sizes", sizes_json(set)},
               {"boxes", counts.boxes},
               {"targets", counts.targets},
               {"targets_with_margins", counts.with_margins},
               {"no_boxes", set.source.no_boxes.empty() ? Json() : Json(set.source.no_boxes)},
               {"noise_method", noise_method(set)},
               {"video_noise", still_json(set.still)},
               {"histogram", histogram_json(set)},
               {"power_curve", curve_json(set)},
               {"targets_by_altitude", altitudes_json(set)},
               {"margins_by_blob_size", margins_json(set, MarginsBy::blob)},
               {"margins_by_box_size", margins_json(set, MarginsBy::box)}};
  if (each) json["each_frame"] = each_json(set);
  return json;
}

}  // namespace

std::string noise_method(const SetFigures& set) {
  if (!set.still) return "no still scene in consecutive frames: spatial estimate from flat blocks alone";
  return fmt::format("temporal components by the 3-D noise model from {} of {} frames of a still scene",
                     set.still->runs == 1 ? "1 run" : fmt::format("{} runs", set.still->runs), kStillFrames);
}

Json to_json(const Comparison& comparison, bool each) {
  Json json = {{"format", "veldt-comparison"},
               {"version", 1},
               {"good_ratio", kGoodRatio},
               {"real", set_json(comparison.real, each)},
               {"dataset", set_json(comparison.other, each)},
               {"curve_edges_per_px", curve_edges()},
               {"measures", measures_json(comparison)},
               {"frame_features", frame_features()},
               {"crop_features", crop_features()},
               {"frames_told_apart", classification_json(comparison.frames, frame_features())},
               {"crops_told_apart", classification_json(comparison.crops, crop_features())}};
  if (const auto& levels = comparison.real.source.kelvin)
    json["levels"] = {{"lowest_k", levels->lowest_k}, {"kelvin_per_level", levels->kelvin_per_level}};
  return json;
}

}  // namespace thermal
