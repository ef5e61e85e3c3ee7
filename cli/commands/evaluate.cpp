#include "analysis/evaluate.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/command.h"
#include "cli/output.h"
#include "dataset/label_source.h"
#include "io/label_files/detections.h"

namespace veldt {
namespace {

inline constexpr std::array kSizes = {thermal::SizeClass::small, thermal::SizeClass::medium,
                                      thermal::SizeClass::large};

/// The columns of a row: each of kSizes, then all.
[[nodiscard]] std::vector<thermal::Counts> columns_of(const thermal::SizeCounts& counts);

/// Undefined values are "-".
std::string to_text(const std::optional<double>& figure) {
  return figure ? fmt::format("{:.3f}", *figure) : "-";
}

using CellText = std::string (*)(const thermal::Counts& counts);

std::string rates_of(const thermal::Counts& counts) {
  return fmt::format("{} {:>7}", to_text(counts.precision()), to_text(counts.recall()));
}

std::string counts_of(const thermal::Counts& counts) {
  return fmt::format("{}/{}/{}", counts.true_positives, counts.false_positives, counts.false_negatives);
}

/// Prints tables: a column of clip or category names, one column per size class, and one for all sizes.
class Tables {
 public:
  Tables(const thermal::LabelSet& truth, const thermal::Evaluation& evaluation)
      : truth_(truth), evaluation_(evaluation) {
    for (const thermal::LabelVideo& video : truth.videos) width_ = std::max(width_, video.name.size());
    for (const thermal::LabelCategory& category : truth.categories)
      width_ = std::max(width_, category.name.size());
    for (const thermal::Counts& column : columns_of(evaluation.overall()))
      cell_width_ = std::max(cell_width_, counts_of(column).size());
  }

  void print_by_size(const std::string& name, CellText text) const {
    print("\n");
    print_name(name);
    for (const thermal::SizeClass size : kSizes) print_cell(size_class_name(size));
    print_cell("all");
    print("\n");
    for (std::size_t i = 0; i < truth_.videos.size(); ++i)
      print_row(truth_.videos[i].name, evaluation_.of_video(i), text);
    print("\n");
    for (std::size_t i = 0; i < truth_.categories.size(); ++i)
      print_row(truth_.categories[i].name, evaluation_.of_category(i), text);
    print_row("all", evaluation_.overall(), text);
  }

  void print_averages() const {
    print("\n");
    print_name("average precision");
    print(" {:>7} {:>7}\n", "AP50", "AP50:95");
    for (std::size_t i = 0; i < truth_.categories.size(); ++i)
      print_average(truth_.categories[i].name, evaluation_.average_precision[i]);
    print_average("mean", evaluation_.mean_average_precision);
  }

 private:
  void print_name(const std::string& name) const { print("{:<{}}", name, width_); }

  void print_cell(const std::string& text) const { print(" {:>{}}", text, cell_width_); }

  void print_row(const std::string& name, const thermal::SizeCounts& counts, CellText text) const {
    print_name(name);
    for (const thermal::Counts& column : columns_of(counts)) print_cell(text(column));
    print("\n");
  }

  void print_average(const std::string& name, const thermal::AveragePrecision& precision) const {
    print_name(name);
    print(" {:>7} {:>7}\n", to_text(precision.at_50), to_text(precision.at_50_to_95));
  }

  const thermal::LabelSet& truth_;
  const thermal::Evaluation& evaluation_;
  std::size_t width_ = std::string("precision and recall").size();
  std::size_t cell_width_ = 15;
};

std::vector<thermal::Counts> columns_of(const thermal::SizeCounts& counts) {
  std::vector<thermal::Counts> columns(counts.begin(), counts.end());
  columns.push_back(total(counts));
  return columns;
}

/// Prints the sources, then precision and recall and the counts behind them by clip and by category, each in columns of
/// size classes, then average precision. Undefined values are "-".
void print_tables(const thermal::Evaluation& evaluation, const thermal::LabelSet& truth,
                  std::size_t detections, const thermal::EvaluateOptions& options) {
  const thermal::Counts all = total(evaluation.overall());
  print("{} pictures; {} targets, {} of them ignored\n", truth.images.size(), truth.labels.size(),
        evaluation.ignored_targets);
  print("{} detections, {} of score {} or more, {} of these on ignored targets\n", detections,
        all.true_positives + all.false_positives + evaluation.ignored_detections, options.score,
        evaluation.ignored_detections);
  print("a target is found at IoU {} or more\n", options.iou);
  const Tables tables(truth, evaluation);
  tables.print_by_size("precision and recall", rates_of);
  tables.print_by_size("TP/FP/FN", counts_of);
  tables.print_averages();
}

struct EvaluateArguments {
  std::string truth;
  std::string detections;
  thermal::EvaluateOptions evaluate;
  bool json = false;
};

/// Undefined values are null.
thermal::Json to_json(const std::optional<double>& figure) {
  return figure ? thermal::Json(*figure) : thermal::Json();
}

thermal::Json to_json(const thermal::SizeCounts& counts) {
  thermal::Json row;
  const std::vector<thermal::Counts> columns = columns_of(counts);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    row[i < kSizes.size() ? size_class_name(kSizes[i]) : "all"] = {
        {"precision", to_json(columns[i].precision())},
        {"recall", to_json(columns[i].recall())},
        {"true_positives", columns[i].true_positives},
        {"false_positives", columns[i].false_positives},
        {"false_negatives", columns[i].false_negatives}};
  }
  return row;
}

thermal::Json to_json(const thermal::AveragePrecision& precision) {
  return {{"ap50", to_json(precision.at_50)}, {"ap50_95", to_json(precision.at_50_to_95)}};
}

/// Precision and recall of a clip, overall and by category.
thermal::Json clip_to_json(const thermal::LabelSet& truth, const thermal::Evaluation& evaluation,
                           std::size_t video) {
  thermal::Json categories = thermal::Json::array();
  for (std::size_t i = 0; i < truth.categories.size(); ++i) {
    categories.push_back(
        {{"name", truth.categories[i].name}, {"sizes", to_json(evaluation.counts[video][i])}});
  }
  return {{"name", truth.videos[video].name},
          {"sizes", to_json(evaluation.of_video(video))},
          {"categories", std::move(categories)}};
}

thermal::Json to_json(const EvaluateArguments& options, const thermal::LabelSet& truth,
                      std::size_t detections, const thermal::Evaluation& evaluation) {
  thermal::Json document = {{"truth", options.truth},
                            {"detections", options.detections},
                            {"iou", options.evaluate.iou},
                            {"score", options.evaluate.score},
                            {"count_ignored", options.evaluate.count_ignored},
                            {"pictures", truth.images.size()},
                            {"targets", truth.labels.size()},
                            {"ignored_targets", evaluation.ignored_targets},
                            {"detections_read", detections},
                            {"ignored_detections", evaluation.ignored_detections},
                            {"average_precision", to_json(evaluation.mean_average_precision)},
                            {"sizes", to_json(evaluation.overall())}};
  thermal::Json categories = thermal::Json::array();
  for (std::size_t i = 0; i < truth.categories.size(); ++i) {
    categories.push_back({{"name", truth.categories[i].name},
                          {"average_precision", to_json(evaluation.average_precision[i])},
                          {"sizes", to_json(evaluation.of_category(i))}});
  }
  document["categories"] = std::move(categories);
  thermal::Json clips = thermal::Json::array();
  for (std::size_t video = 0; video < truth.videos.size(); ++video) {
    clips.push_back(clip_to_json(truth, evaluation, video));
  }
  document["clips"] = std::move(clips);
  return document;
}

int run_evaluate(const EvaluateArguments& options) {
  options.evaluate.validate();
  const thermal::LabelSet truth = thermal::read_labels(options.truth);
  if (truth.labels.empty())
    throw thermal::DataError(thermal::fault(options.truth, "0 labels", "", "at least one"));
  const std::vector<thermal::Detection> detections = thermal::read_detections(options.detections, truth);
  const thermal::Evaluation evaluation = thermal::evaluate(truth, detections, options.evaluate);
  if (options.json) {
    print_json(to_json(options, truth, detections.size(), evaluation));
  } else {
    print_tables(evaluation, truth, detections.size(), options.evaluate);
  }
  return kDone;
}

}  // namespace

void add_evaluate(Parser& parser) {
  Command command =
      parser.add_command("evaluate", "Precision, recall and average precision of a detector's results");
  command.footer(
      "Precision and recall are reported by clip, category and size class. The size class of a target\n"
      "is that of its track's mean box (below 200 px small, above 2000 px large); that of a detection\n"
      "without a target is that of its own box.\n"
      "Average precision agrees with pycocotools. Targets marked as ignored, and crowds, count neither\n"
      "as found nor as missed; detections that match them are not counted.\n"
      "Example: veldt evaluate --truth my_dataset --detections results.json");
  auto options = std::make_shared<EvaluateArguments>();
  command.add_option("--truth", options->truth, "Labels: a dataset, a BIRDSAI folder or a COCO file")
      .required();
  command
      .add_option("--detections", options->detections,
                  "Detections: COCO results (.json), Ultralytics' too, or a folder of YOLO results "
                  "(VIDEO_PICTURE.txt)")
      .required();
  command.add_option("--iou", options->evaluate.iou, "Lowest IoU at which a detection matches a target")
      .shows_default();
  command.add_option("--score", options->evaluate.score, "Lowest score of the detections to count")
      .shows_default();
  command.add_flag("--count-ignored", options->evaluate.count_ignored,
                   "Count targets that are marked as ignored like any others, as pycocotools does");
  command.add_flag("--json", options->json, "Print JSON, with each clip's categories too");
  command.runs([options](const CommonOptions& /*common*/) { return run_evaluate(*options); });
}

}  // namespace veldt
