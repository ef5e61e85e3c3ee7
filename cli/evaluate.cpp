#include "analysis/evaluate.h"

#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "cli/command.h"
#include "cli/evaluation_table.h"
#include "cli/output.h"
#include "dataset/label_source.h"
#include "io/label_files/detections.h"

namespace veldt {
namespace {

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

void add_evaluate(CLI::App& app, Session& session) {
  CLI::App* command = add_command(app, session, "evaluate",
                                  "Precision, recall and average precision of a detector's results");
  command->footer(
      "Precision and recall are reported by clip, category and size class. The size class of a target\n"
      "is that of its track's mean box (below 200 px small, above 2000 px large); that of a detection\n"
      "without a target is that of its own box.\n"
      "Average precision agrees with pycocotools. Targets marked as ignored, and crowds, count neither\n"
      "as found nor as missed; detections that match them are not counted.\n"
      "Example: veldt evaluate --truth my_dataset --detections results.json");
  auto options = std::make_shared<EvaluateArguments>();
  command->add_option("--truth", options->truth, "Labels: a dataset, a BIRDSAI folder or a COCO file")
      ->required();
  command
      ->add_option("--detections", options->detections,
                   "Detections: COCO results (.json), Ultralytics' too, or a folder of YOLO results "
                   "(VIDEO_PICTURE.txt)")
      ->required();
  command->add_option("--iou", options->evaluate.iou, "Lowest IoU at which a detection matches a target")
      ->capture_default_str();
  command->add_option("--score", options->evaluate.score, "Lowest score of the detections to count")
      ->capture_default_str();
  command->add_flag("--count-ignored", options->evaluate.count_ignored,
                    "Count targets that are marked as ignored like any others, as pycocotools does");
  command->add_flag("--json", options->json, "Print JSON, with each clip's categories too");
  command->callback([options, &session] { session.run = [options] { return run_evaluate(*options); }; });
}

}  // namespace veldt
