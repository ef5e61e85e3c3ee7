#include "cli/evaluation_table.h"

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/output.h"

namespace veldt {
namespace {

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

}  // namespace

std::vector<thermal::Counts> columns_of(const thermal::SizeCounts& counts) {
  std::vector<thermal::Counts> columns(counts.begin(), counts.end());
  columns.push_back(total(counts));
  return columns;
}

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

}  // namespace veldt
