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

struct EvaluateOptions {
  double iou = 0.5;            ///< least overlap of a detection with the target it finds, above 0, at most 1
  double score = 0.5;          ///< detections below do not count, except in average precision
  bool count_ignored = false;  ///< targets marked to be ignored count like others

  /// ConfigError naming the option of the command line.
  void validate() const;
};

/// How detections met targets.
struct Counts {
  std::int64_t true_positives = 0;   ///< targets found
  std::int64_t false_positives = 0;  ///< detections that found none
  std::int64_t false_negatives = 0;  ///< targets missed

  [[nodiscard]] std::optional<double> precision() const;  ///< none without a detection
  [[nodiscard]] std::optional<double> recall() const;     ///< none without a target
  Counts& operator+=(const Counts& other) noexcept;
  [[nodiscard]] bool operator==(const Counts&) const = default;
};

/// By SizeClass: a target's own, which is its track's; of a detection that found none, its box's by itself.
using SizeCounts = std::array<Counts, 3>;

[[nodiscard]] Counts total(const SizeCounts& counts) noexcept;

struct Evaluation {
  /// [video][category], as in the set.
  std::vector<std::vector<SizeCounts>> counts;
  std::vector<AveragePrecision> average_precision;  ///< by category
  AveragePrecision mean_average_precision;
  std::int64_t ignored_targets = 0;     ///< crowds, and those marked to be ignored
  std::int64_t ignored_detections = 0;  ///< sure enough, and found one of those

  [[nodiscard]] SizeCounts of_video(std::size_t video) const;        ///< all categories
  [[nodiscard]] SizeCounts of_category(std::size_t category) const;  ///< all videos
  [[nodiscard]] SizeCounts overall() const;
};

/// Precision and recall per video, category and size class (as tabulated by Bondi et al., COMPASS 2018), and COCO's
/// average precision. Detections meet targets of their picture and category alone, by the rules of match(); those
/// that find an ignored target count neither way.
/// @param truth  with size classes; without labels, there is nothing to find
/// @param detections  their places must be in `truth`; the same may come twice
[[nodiscard]] Evaluation evaluate(const LabelSet& truth, std::span<const Detection> detections,
                                  const EvaluateOptions& options);

}  // namespace thermal
