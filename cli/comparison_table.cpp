#include "cli/comparison_table.h"

#include <string>

#include <fmt/format.h>

#include "analysis/compare/comparison_json.h"
#include "analysis/compare/target_tables.h"
#include "cli/output.h"

namespace veldt {
namespace {

using thermal::Comparison;
using thermal::SetFigures;

/// Undefined values are "-".
std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.3g}", *value) : "-"; }

/// Logarithms with two decimals, which shows their differences.
std::string number(const std::optional<double>& value, const std::string& unit) {
  return value && unit == "log10" ? fmt::format("{:.2f}", *value) : number(value);
}

void print_set(const char* what, const SetFigures& set) {
  const thermal::TargetCounts counts = target_counts(set);
  print("{:<8} {}: {} of {} frames, {} boxes, {} targets\n", what, set.source.name, set.frames.size(),
        set.source.frames.size(), counts.boxes, counts.targets);
  print("{:<8} noise: {}\n", "", noise_method(set));
  if (!set.source.no_boxes.empty())
    print("{:<8} {}; measures of targets are left out\n", "", set.source.no_boxes);
}

void print_measure(const thermal::Measure& measure, const thermal::ComparedMeasure& row) {
  const std::string name =
      measure.unit.empty() ? measure.name : fmt::format("{} [{}]", measure.name, measure.unit);
  print("  {:<40} {:>9} {:>9} {:>10} {:>10} {:>7}{}\n", name, number(row.real, measure.unit),
        number(row.other, measure.unit), number(row.difference, measure.unit), number(row.real_difference),
        number(row.ratio), row.is_good() ? "  *" : "");
}

void print_measures(const Comparison& comparison) {
  print("\n{:<42} {:>9} {:>9} {:>10} {:>10} {:>7}\n", "", "real", "dataset", "difference", "real-real",
        "ratio");
  std::string group;
  std::size_t good = 0;
  for (std::size_t k = 0; k < comparison.measures.size(); ++k) {
    const thermal::Measure& measure = thermal::measures()[k];
    const thermal::ComparedMeasure& row = comparison.measures[k];
    if (!row.real && !row.other) continue;
    if (measure.group != group) print("{}\n", measure.group);
    group = measure.group;
    print_measure(measure, row);
    if (row.is_good()) ++good;
  }
  print("* within {} times what halves of the real frames differ: {} measures\n", thermal::kGoodRatio, good);
}

void print_video_noise(const Comparison& comparison) {
  if (!comparison.real.still && !comparison.other.still) return;
  print("\n{:<42} {:>9} {:>9}\n", "temporal noise of a still scene [levels]", "real", "dataset");
  const auto row = [&comparison](const char* name, double thermal::VideoNoise::*component) {
    const auto of = [component](const SetFigures& set) {
      return number(set.still ? std::optional(set.still->noise.*component) : std::nullopt);
    };
    print("  {:<40} {:>9} {:>9}\n", name, of(comparison.real), of(comparison.other));
  };
  row("pixels (sigma_tvh)", &thermal::VideoNoise::random);
  row("rows (sigma_tv)", &thermal::VideoNoise::rows);
  row("columns (sigma_th)", &thermal::VideoNoise::columns);
  row("frames (sigma_t)", &thermal::VideoNoise::frames);
}

void print_classification(const char* what, const std::optional<thermal::Classification>& classified,
                          const std::vector<std::string>& features) {
  print("\n");
  if (!classified) {
    print("classifier of {}: left out; it needs {} in two parts or more of each set\n", what, what);
    return;
  }
  print("classifier of {}: AUC {:.3f} +- {:.3f}", what, classified->sets.auc, classified->sets.error);
  if (classified->real_halves)
    print("; real against real {:.3f} +- {:.3f}", classified->real_halves->auc,
          classified->real_halves->error);
  print("\n");
  print("  {:<40} {:>9} {:>9} {:>9}\n", "feature", "AUC falls", "AUC alone", "real-real");
  for (const thermal::Importance& one : classified->sets.importances) {
    const auto halves = classified->halves_alone.empty()
                            ? std::nullopt
                            : std::optional(classified->halves_alone[one.feature]);
    print("  {:<40} {:>9.3f} {:>9.3f} {:>9}\n", features[one.feature], one.fall, one.alone, number(halves));
  }
}

void print_altitudes(const char* what, const SetFigures& set) {
  for (const thermal::AltitudeRow& row : targets_by_altitude(set)) {
    print("  {:<8} {:>4.0f} to {:>4.0f} m {:>8} {:>8.3g} {:>8.3g} {:>9.3g} {:>9.3g}\n", what, row.from_m,
          row.to_m, row.targets, row.width_px, row.height_px, row.contrast, row.ring_deviation);
  }
}

std::string spread(const thermal::MeanAndDeviation& value) {
  return fmt::format("{:.1f} +- {:.1f}", value.mean, value.deviation);
}

void print_margins(const char* what, const SetFigures& set) {
  for (const thermal::MarginRow& row : margins_by_size(set, thermal::MarginsBy::blob)) {
    const std::string limit = row.to_px > 0 ? fmt::format("to {:>2.0f}", row.to_px) : "up   ";
    print("  {:<8} {:>2.0f} {} px {:>8} {:>14} {:>14} {:>14} {:>14}\n", what, row.from_px, limit, row.targets,
          spread(row.left_px), spread(row.right_px), spread(row.top_px), spread(row.bottom_px));
  }
}

void print_targets(const Comparison& comparison) {
  if (target_counts(comparison.real).targets + target_counts(comparison.other).targets == 0) return;
  if (targets_by_altitude(comparison.real).size() + targets_by_altitude(comparison.other).size() > 0) {
    print("\ntargets by height above ground: medians\n  {:<8} {:<14} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "",
          "height", "count", "width", "height", "contrast", "ring");
  }
  print_altitudes("real", comparison.real);
  print_altitudes("dataset", comparison.other);
  print(
      "\nmargins: from the box to the warm blob in it [px], by the blob's longer side; known of {} and {} "
      "targets\n",
      target_counts(comparison.real).with_margins, target_counts(comparison.other).with_margins);
  print("  {:<8} {:<11} {:>8} {:>14} {:>14} {:>14} {:>14}\n", "", "blob", "count", "left", "right", "top",
        "bottom");
  print_margins("real", comparison.real);
  print_margins("dataset", comparison.other);
}

}  // namespace

void print_tables(const Comparison& comparison) {
  print_set("real", comparison.real);
  print_set("dataset", comparison.other);
  if (const auto& levels = comparison.real.source.kelvin)
    print("levels   of {:.3g} K, from {:.2f} K to {:.2f} K\n", levels->kelvin_per_level, levels->lowest_k,
          levels->lowest_k + 255 * levels->kelvin_per_level);
  print_measures(comparison);
  print_video_noise(comparison);
  print_classification("frames", comparison.frames, thermal::frame_features());
  print_classification("targets", comparison.crops, thermal::crop_features());
  print_targets(comparison);
}

}  // namespace veldt
