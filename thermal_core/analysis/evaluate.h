#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "analysis/average_precision.h"
#include "labels/detection.h"
#include "labels/label_set.h"

namespace thermal {

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
