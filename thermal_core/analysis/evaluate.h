#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "labels/label_set.h"

namespace thermal {

/// A target, as used by matching.
struct Target {
  LabelBox box;
  bool crowd = false;     ///< a group without separate boxes: any number of detections may match it
  bool ignored = false;   ///< a match or a miss does not count; true for all crowds
  std::size_t label = 0;  ///< index into LabelSet::labels
};

/// The detections and targets of one category in one picture.
struct EvaluationCell {
  std::size_t image = 0;
  std::size_t category = 0;
  std::span<const Detection> detections;  ///< by falling score; equal scores in the order given
  std::span<const Target> targets;  ///< those that count, then ignored ones; each in the order of the set
};

/// All cells of a set with its detections, by category and, within one, by the ids of the pictures.
class EvaluationCells {
 public:
  /// @param count_ignored  targets marked as ignored count like others; crowds never do
  EvaluationCells(const LabelSet& truth, std::span<const Detection> detections, bool count_ignored);
  EvaluationCells(const EvaluationCells&) = delete;
  EvaluationCells& operator=(const EvaluationCells&) = delete;

  [[nodiscard]] std::span<const EvaluationCell> all() const noexcept { return cells_; }

 private:
  std::vector<Detection> detections_;
  std::vector<Target> targets_;
  std::vector<EvaluationCell> cells_;
};

/// Intersection over union, 0..1; over the detection's own area if the target is a crowd. 0 if boxes only touch.
[[nodiscard]] double overlap(const LabelBox& detection, const Target& target) noexcept;

/// The index of a detection that matches no target.
inline constexpr std::size_t kNoTarget = static_cast<std::size_t>(-1);

/// Which target each detection matches, as an index into `cell.targets`, or kNoTarget: in order, each takes the
/// unmatched target of largest overlap, at least `iou`; the last of equal ones. Targets that count take precedence over
/// ignored ones, regardless of overlap. These are COCO's rules (pycocotools 2.0, COCOeval), to the bit.
/// @param iou  above 0, at most 1; like COCO, accepts an overlap of 1 - 1e-10 as 1
[[nodiscard]] std::vector<std::size_t> match(const EvaluationCell& cell, double iou);

/// Average precision at IoU 0.5, and the mean of those at 0.5, 0.55 … 0.95; 0..1, empty where undefined.
struct AveragePrecision {
  std::optional<double> at_50;
  std::optional<double> at_50_to_95;
};

/// COCO's IoU thresholds, with numpy's rounding: 0.9 is 0.8999999999999999.
inline constexpr std::size_t kIouSteps = 10;
/// 0.5, 0.55 … 0.95.
[[nodiscard]] std::array<double, kIouSteps> iou_steps() noexcept;

/// Area under the precision-recall curve as COCO defines it: precision made non-increasing in recall, and its mean at
/// the recalls 0, 0.01 … 1, with 0 where recall was not reached.
/// @param found  whether each detection matched a target, by falling score; ignored detections are left out
/// @param targets  number of targets to find, above 0
[[nodiscard]] double average_precision(const std::vector<bool>& found, std::size_t targets);

/// Average precision of one category as COCO defines it (pycocotools 2.0, COCOeval, boxes, all areas, the 100
/// detections of highest score per picture). Equal scores are ranked by the ids of their pictures, then in the order
/// given.
/// @param cells  all cells of this category, from EvaluationCells
[[nodiscard]] AveragePrecision average_precision_of(std::span<const EvaluationCell> cells);

/// Means over the categories with figures; empty without any.
[[nodiscard]] AveragePrecision mean_of(std::span<const AveragePrecision> categories);

/// Options of an evaluation: which detections count, and what a match is.
struct EvaluateOptions {
  double iou = 0.5;            ///< lowest IoU of a match, above 0, at most 1
  double score = 0.5;          ///< lower scores do not count, except in average precision
  bool count_ignored = false;  ///< count ignored targets like others

  /// ConfigError with the name of the command line option.
  void validate() const;
};

/// Counts of matches between detections and targets.
struct Counts {
  std::int64_t true_positives = 0;   ///< targets found
  std::int64_t false_positives = 0;  ///< detections without a target
  std::int64_t false_negatives = 0;  ///< targets missed

  [[nodiscard]] std::optional<double> precision() const;  ///< empty without detections
  [[nodiscard]] std::optional<double> recall() const;     ///< empty without targets
  Counts& operator+=(const Counts& other) noexcept;
  [[nodiscard]] bool operator==(const Counts&) const = default;
};

/// By SizeClass: a target's is its track's; an unmatched detection's is that of its own box.
using SizeCounts = std::array<Counts, 3>;

/// The sum over all sizes.
[[nodiscard]] Counts total(const SizeCounts& counts) noexcept;

/// Agreement of detections with labels.
struct Evaluation {
  /// [video][category], as in the set.
  std::vector<std::vector<SizeCounts>> counts;
  std::vector<AveragePrecision> average_precision;  ///< by category
  AveragePrecision mean_average_precision;
  std::int64_t ignored_targets = 0;     ///< crowds, and those marked to be ignored
  std::int64_t ignored_detections = 0;  ///< with a sufficient score, matched to one of those

  [[nodiscard]] SizeCounts of_video(std::size_t video) const;        ///< all categories
  [[nodiscard]] SizeCounts of_category(std::size_t category) const;  ///< all videos
  [[nodiscard]] SizeCounts overall() const;
};

/// Precision and recall per video, category and size class (as tabulated by Bondi et al., COMPASS 2018), and COCO's
/// average precision. Detections are matched with targets of their picture and category by the rules of match();
/// those that match an ignored target are not counted.
/// @param truth  with size classes and at least one label
/// @param detections  their indices must be in `truth`; duplicates are allowed
[[nodiscard]] Evaluation evaluate(const LabelSet& truth, std::span<const Detection> detections,
                                  const EvaluateOptions& options);

}  // namespace thermal
