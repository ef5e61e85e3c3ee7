#include <array>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "analysis/compare/comparison.h"
#include "analysis/compare/comparison_page.h"
#include "analysis/compare/set_figures.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "io/assets.h"
#include "io/image/kelvin_picture.h"

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

/// Prints the sources, one row per measure, the separability by a classifier, and tables of targets.
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

struct CompareArguments {
  std::string real;
  std::string dataset;
  std::string real_labels;
  std::string labels;
  std::string real_names;
  std::string names;
  std::string category;
  thermal::BoxStyle boxes = thermal::BoxStyle::visible;
  std::string html;
  int frames = thermal::CompareOptions().most_frames;
  bool json = false;
  bool kelvin = false;
  thermal::StoredScale real_scale = {.prefix = "--real-"};
  thermal::StoredScale scale;
};

thermal::CompareOptions request_of(const CompareArguments& options) {
  return {.real = {.source = options.real,
                   .labels = options.real_labels,
                   .names = options.real_names,
                   .names_option = "--real-names",
                   .category = options.category,
                   .kelvin = options.kelvin,
                   .scale = options.real_scale},
          .other = {.source = options.dataset,
                    .labels = options.labels,
                    .names = options.names,
                    .names_option = "--names",
                    .category = options.category,
                    .boxes = options.boxes,
                    .kelvin = options.kelvin,
                    .scale = options.scale},
          .most_frames = options.frames};
}

thermal::Comparison compared(const CompareArguments& options, const CommonOptions& common) {
  ProgressBar bar(common, "starting", "frames", kClipPatience);
  const auto hooks = hooks_for(bar);
  thermal::CompareOptions request = request_of(options);
  request.show = [&hooks](std::size_t done, std::size_t total) {
    hooks.progress({.clip = "frames", .done = static_cast<int>(done), .total = static_cast<int>(total)});
  };
  return thermal::compare(request);
}

/// Called before any frame is read, because reading them may take a while.
void check_page(const thermal::Path& file) {
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path()))
    throw thermal::ConfigError(thermal::fault("--html", file.string(), "", "a file in an existing folder"));
}

/// Adds --PREFIXkelvin-per-count and --PREFIXunit, which require `kelvin`.
void add_scale(Command& command, const Option& kelvin, thermal::StoredScale& scale,
               const std::array<const char*, 2>& help) {
  command.add_option(scale.prefix + "kelvin-per-count", scale.kelvin_per_count, help[0])
      .needs(kelvin)
      .positive()
      .type_name("KELVIN");
  command
      .add_option(
          scale.prefix + "unit",
          [&scale](const std::string& name) {
            scale.unit =
                name == "celsius" ? thermal::TemperatureUnit::celsius : thermal::TemperatureUnit::kelvin;
          },
          help[1])
      .needs(kelvin)
      .one_of({"kelvin", "celsius"});
}

bool print_rejected(const thermal::SetFigures& set) {
  for (const std::string& rejected : set.rejected) print_error("rejected: {}\n", rejected);
  return !set.rejected.empty();
}

int run_compare(const CompareArguments& options, const CommonOptions& common) {
  check_page(options.html);
  const thermal::Comparison comparison = compared(options, common);
  if (options.json) {
    print_json(to_json(comparison, true));
  } else if (!common.quiet) {
    print_tables(comparison);
  }
  if (!options.html.empty())
    thermal::write_file_atomically(options.html,
                                   thermal::comparison_page(comparison, thermal::Assets::find()));
  const bool real_rejected = print_rejected(comparison.real);
  return print_rejected(comparison.other) || real_rejected ? kSomeRejected : kDone;
}

}  // namespace

void add_compare(Parser& parser) {
  Command command = parser.add_command(
      "compare", "How far frames are from real ones: spectra, grey levels, edges, noise, targets");
  command.footer(
      "Each source is a Veldt dataset (its ir8), or a folder of grey pictures of 8 or 16 bits (.png, .jpg,\n"
      ".jpeg, .tif, .tiff) with labels of COCO. Differences are put beside those between random halves of\n"
      "the real frames; a measure within twice those is marked. A classifier's AUC says how well frames,\n"
      "or crops of targets, can be distinguished: .5 not at all, 1 always.\n"
      "Frames may have different sizes: each is measured as it is, and power is scaled to 640 x 512 px.\n"
      "Example: veldt compare real_frames my_dataset --box-style drawn --html comparison.html");
  auto options = std::make_shared<CompareArguments>();
  command.add_option("real", options->real, "Real frames").required();
  command.add_option("dataset", options->dataset, "Frames to compare with them").required();
  command
      .add_option("--real-labels", options->real_labels,
                  "Labels of a folder of real frames; by default annotations.json in it or in its parent")
      .type_name("FILE");
  command.add_option("--labels", options->labels, "The same of the other frames").type_name("FILE");
  command
      .add_option("--real-names", options->real_names,
                  "What names of real frames say, such as \"{_}_{altitude_m}_{look_angle_deg}_{_}\"")
      .type_name("PATTERN");
  command.add_option("--names", options->names, "The same of the other frames").type_name("PATTERN");
  command.add_option("--category", options->category, "Category of the targets (default: people)")
      .type_name("NAME");
  add_box_style(command, options->boxes,
                "Boxes of DATASET around visible pixels, or with the margin that people leave, as in REAL");
  const Option kelvin = command.add_flag(
      "--kelvin", options->kelvin,
      "Frames are temperatures: ir16 of a dataset, TIFFs of floats or of counts with a scale, 16-bit PNGs");
  add_scale(command, kelvin, options->real_scale,
            {"Scale of a folder's 16-bit real frames; by default their tags say it",
             "Unit of a folder's real frames; by default their tags say it, or it is kelvin"});
  add_scale(command, kelvin, options->scale,
            {"The same scale of the other frames", "The same unit of the other frames"});
  command.add_option("--frames", options->frames, "Most frames of each source, evenly spaced")
      .shows_default();
  command
      .add_option("--html", options->html,
                  "Write a page with charts, frames and crops of targets; needs no network")
      .type_name("FILE");
  command.add_flag("--json", options->json, "Print JSON, with the figures of each frame and target");
  command.runs([options](const CommonOptions& common) { return run_compare(*options, common); });
}

}  // namespace veldt
