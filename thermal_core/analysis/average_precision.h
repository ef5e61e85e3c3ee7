#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "analysis/matching.h"

namespace thermal {

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

}  // namespace thermal
